// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/solid_texture.h"

#include <array>
#include <cmath>

#include "core/base/status.h"
#include "core/synthetic/facade_texture.h"

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

Colour Leaves(const Eigen::Vector3d& local, double pixel_m, uint32_t seed) {
  const NoiseBand band{0.4, 0.04};
  const double a = FractalNoise(local.x() + 0.7 * local.z(), local.y(), band, 1.5 * pixel_m, seed);
  const double b =
      FractalNoise(local.y() + 0.6 * local.x(), local.z(), band, 1.5 * pixel_m, seed + 50);
  return Tinted({0.24, 0.34, 0.15}, 0.25, seed) * std::max(0.15, 1.0 + 1.2 * (a + b));
}

Colour Paint(uint32_t seed) {
  static const std::array<Colour, 6> kPaints = {Colour{0.70, 0.71, 0.72},
                                                Colour{0.13, 0.14, 0.16},
                                                Colour{0.55, 0.10, 0.10},
                                                Colour{0.14, 0.22, 0.42},
                                                Colour{0.84, 0.84, 0.82},
                                                Colour{0.36, 0.38, 0.36}};
  return Tinted(kPaints[HashOf(0, 9, seed) % kPaints.size()], 0.1, seed);
}

double DiscCover(const TexturePoint& p, double u_m, double v_m, double radius_m) {
  return CoverInterval(std::hypot(p.u_m - u_m, p.v_m - v_m), -1.0, radius_m, p.Footprint());
}

/// Sides with wheels and doors; front and back with lamps and a number plate.
Colour CarBody(const TexturePoint& p, int face, uint32_t seed) {
  const double dust = FractalNoise(p.u_m, p.v_m, {1.0, 0.03}, p.Footprint(), HashOf(face, 1, seed));
  const Colour paint = Paint(seed) * (1.0 + 0.25 * dust);
  const Colour dark(0.05, 0.05, 0.06);
  const Colour bright(0.75, 0.74, 0.68);
  if (face / 2 == 1) {
    Colour colour = paint;
    for (const double u : {0.19 * p.width_m, 0.81 * p.width_m}) {
      colour = Mix(colour, dark, DiscCover(p, u, 0.1, 0.36));
      colour = Mix(colour, 0.6 * bright, DiscCover(p, u, 0.1, 0.19));
    }
    for (const double u : {0.33, 0.52, 0.68}) {
      colour = Mix(
          colour, 0.4 * paint, CoverInterval(p.u_m, u * p.width_m, u * p.width_m + 0.015, p.du_m));
    }
    return colour;
  }
  if (face / 2 == 0) {
    const double plate =
        CoverInterval(p.u_m, 0.63, 1.15, p.du_m) * CoverInterval(p.v_m, 0.2, 0.32, p.dv_m);
    const Colour lamp = face % 2 == 1 ? bright : Colour(0.6, 0.08, 0.06);
    const double lamps =
        DiscCover(p, 0.25, 0.45, 0.13) + DiscCover(p, p.width_m - 0.25, 0.45, 0.13);
    return Mix(Mix(paint, bright, plate), lamp, lamps);
  }
  return paint;
}

Colour CarCabin(const TexturePoint& p, int face, uint32_t seed) {
  const Colour paint = Paint(seed);
  if (face / 2 == 2) return paint;
  const double pane = CoverInterval(p.u_m, 0.1, 0.5 * p.width_m - 0.04, p.du_m) +
                      CoverInterval(p.u_m, 0.5 * p.width_m + 0.04, p.width_m - 0.1, p.du_m);
  return Mix(
      paint, {0.10, 0.12, 0.14}, pane * CoverInterval(p.v_m, 0.05, p.height_m - 0.08, p.dv_m));
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

Colour SolidColour(const Solid& solid,
                   int face,
                   const Eigen::Vector3d& point,
                   const Eigen::Vector3d& direction,
                   double pixel_m) {
  const Eigen::Vector3d local = solid.LocalDirection(point - solid.centre);
  if (solid.kind == SolidKind::kCrown) return Leaves(local, pixel_m, solid.seed);
  const TexturePoint p = OnFace(solid, face, local, solid.LocalDirection(direction), pixel_m);
  const uint32_t seed = FaceSeed(solid, face);
  switch (solid.kind) {
    case SolidKind::kBuilding:
      return face / 2 == 2 ? Rough({0.4, 0.38, 0.36}, p, seed) : FacadeColour(p, seed);
    case SolidKind::kFixture:
      return Fixture(p, seed);
    case SolidKind::kPole:
      return Rough({0.38, 0.34, 0.30}, p, seed);
    case SolidKind::kHedge:
      return Leaves(local, p.Footprint(), seed);
    case SolidKind::kCarBody:
      return CarBody(p, face, solid.seed);
    case SolidKind::kCarCabin:
      return CarCabin(p, face, solid.seed);
    case SolidKind::kCrown:
      break;
  }
  ORBWEAVE_CHECK(false);
}

}  // namespace orbweave
