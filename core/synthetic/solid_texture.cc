// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/solid_texture.h"

#include <cmath>

#include "core/base/status.h"
#include "core/synthetic/facade_texture.h"
#include "core/synthetic/room_texture.h"
#include "core/synthetic/traffic_texture.h"

namespace orbweave {
namespace {

/// The point in the coordinates of its face, and the extents of the pixel's elliptical footprint
/// on it: a disc of diameter `pixel_m` projected along the ray.
TexturePoint OnFace(const Solid& solid,
                    int face,
                    const Eigen::Vector3d& local,
                    const Eigen::Vector3d& local_direction,
                    double pixel_m) {
  constexpr double kGrazing = 1e-3;
  const int normal = face / 2;
  const int u = normal == 0 ? 1 : 0;
  const int v = normal == 2 ? 1 : 2;
  const double toward = std::max(kGrazing, std::abs(local_direction[normal]));
  return {.u_m = local[u] + solid.half[u],
          .v_m = local[v] + solid.half[v],
          .width_m = 2.0 * solid.half[u],
          .height_m = 2.0 * solid.half[v],
          .du_m = pixel_m * std::hypot(1.0, local_direction[u] / toward),
          .dv_m = pixel_m * std::hypot(1.0, local_direction[v] / toward)};
}

/// Each face of a solid has noise of its own.
uint32_t FaceSeed(const Solid& solid, int face) { return HashOf(face, 3, solid.seed); }

/// `leaves` changes their pattern, not their tone.
Colour Leaves(const Eigen::Vector3d& local, double pixel_m, uint32_t seed, uint32_t leaves = 0) {
  const NoiseBand band{0.4, 0.04};
  const double a =
      FractalNoise(local.x() + 0.7 * local.z(), local.y(), band, 1.5 * pixel_m, seed + leaves);
  const double b =
      FractalNoise(local.y() + 0.6 * local.x(), local.z(), band, 1.5 * pixel_m, seed + leaves + 50);
  return Tinted({0.24, 0.34, 0.15}, 0.25, seed) * std::max(0.15, 1.0 + 1.2 * (a + b));
}

Colour Rough(const Colour& base, const TexturePoint& p, uint32_t seed) {
  return base * (1.0 + 0.4 * FractalNoise(p.u_m, p.v_m, {1.0, 0.02}, p.Footprint(), seed));
}

/// Grilles, boards and boxes on walls: a frame round slats of random tone.
Colour Fixture(const TexturePoint& p, uint32_t seed) {
  const Colour base = Tinted({0.58, 0.57, 0.55}, 0.5, seed);
  const auto slat = static_cast<int32_t>(std::floor(p.v_m / 0.07));
  const double visible = std::clamp(2.0 - p.dv_m / 0.035, 0.0, 1.0);
  const double tone = 1.0 + 0.7 * visible * (UniformOf(slat, 0, seed) - 0.5);
  const double inside = CoverInterval(p.u_m, 0.06, p.width_m - 0.06, p.du_m) *
                        CoverInterval(p.v_m, 0.06, p.height_m - 0.06, p.dv_m);
  return Rough(Mix(base, 0.75 * tone * base, inside), p, seed);
}

}  // namespace

SurfaceColour LookOfSolid(const Solid& solid,
                          int face,
                          const Eigen::Vector3d& point,
                          const Eigen::Vector3d& direction,
                          double pixel_m) {
  const Eigen::Vector3d local = solid.LocalDirection(point - solid.centre);
  if (solid.kind == SolidKind::kCrown) return {Leaves(local, pixel_m, solid.seed, solid.leaves)};
  if (solid.kind == SolidKind::kPerson)
    return {Clothes(local, 2.0 * solid.half.z(), pixel_m, solid.seed)};
  const TexturePoint p = OnFace(solid, face, local, solid.LocalDirection(direction), pixel_m);
  const uint32_t seed = FaceSeed(solid, face);
  switch (solid.kind) {
    case SolidKind::kBuilding:
      if (face / 2 == 2) return {Rough({0.4, 0.38, 0.36}, p, seed)};
      return FacadeSurface(p, solid.look.plain ? solid.seed : seed, solid.look);
    case SolidKind::kFixture:
      return {Fixture(p, seed)};
    case SolidKind::kPole:
      return {Rough({0.38, 0.34, 0.30}, p, seed)};
    case SolidKind::kHedge:
      return {Leaves(local, p.Footprint(), seed)};
    case SolidKind::kCarBody:
      return CarBody(p, face, solid.seed);
    case SolidKind::kCarCabin:
      return CarCabin(p, face, solid.seed);
    case SolidKind::kBus:
      return Bus(p, face, solid.seed);
    case SolidKind::kPlaster:
    case SolidKind::kFloor:
    case SolidKind::kFurniture:
    case SolidKind::kPicture:
      return {RoomColour(solid.kind, p, face, seed)};
    case SolidKind::kCrown:
    case SolidKind::kPerson:
      break;
  }
  ORBWEAVE_CHECK(false);
}

}  // namespace orbweave
