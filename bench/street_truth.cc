// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/street_truth.h"

#include <algorithm>
#include <cmath>

#include "core/dense/equiangular_raster.h"
#include "core/geometry/cube_face.h"
#include "core/synthetic/solid.h"
#include "core/synthetic/solid_texture.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kGlass = 0.6;  // more than a car's clear coat
constexpr double kSamePoint_m = 0.03;
constexpr int kBesideMoving_px = 2;  // lenses beside the centre see it there

const Traffic& NoTraffic() {
  static const Traffic kNone({});
  return kNone;
}

bool IsCrown(const StreetWorld& world, const SurfaceHit& hit) {
  return hit.surface > SurfaceHit::kGround && world.solids[hit.solid].kind == SolidKind::kCrown;
}

/// Pixels within a few of one that moves.
void GrowMoving(const EquiangularRaster& raster, std::vector<SurfaceKind>& kinds) {
  const std::vector<SurfaceKind> before = kinds;
  const auto moves = [&](int face, int row, int column) {
    for (int r = row - kBesideMoving_px; r <= row + kBesideMoving_px; ++r) {
      for (int c = column - kBesideMoving_px; c <= column + kBesideMoving_px; ++c) {
        if (r < 0 || c < 0 || r >= raster.face_px || c >= raster.face_px) continue;
        if (before[raster.Index(face, r, c)] == SurfaceKind::kMoves) return true;
      }
    }
    return false;
  };
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int row = 0; row < raster.face_px; ++row) {
      for (int column = 0; column < raster.face_px; ++column) {
        if (moves(face, row, column)) kinds[raster.Index(face, row, column)] = SurfaceKind::kMoves;
      }
    }
  }
}

}  // namespace

double RasterTruth::ErrorAt(int face, int row, int column, const Vector3f& point) const {
  const EquiangularRaster raster{face_px};
  double least_m = 1e9;
  for (int r = std::max(0, row - 1); r <= std::min(face_px - 1, row + 1); ++r) {
    for (int c = std::max(0, column - 1); c <= std::min(face_px - 1, column + 1); ++c) {
      const size_t k = raster.Index(face, r, c);
      if (range_m[k] == 0.0F) continue;
      const Vector3f away = point - points[k];
      const double off_m = std::abs(away.dot(normals[k]));
      const double along_m =
          std::sqrt(std::max(0.0, static_cast<double>(away.squaredNorm()) - off_m * off_m));
      const double footprint_m = 2.0 * raster.PixelAngle() * range_m[k];
      const bool is_own = r == row && c == column;
      least_m = std::min(least_m,
                         is_own ? off_m : std::hypot(off_m, std::max(0.0, along_m - footprint_m)));
    }
  }
  return least_m;
}

StreetTruth::StreetTruth(const Street& street, const StreetOptions& options)
    : street_(street), options_(options) {
  const Rigid3 enu_from_street{Eigen::Quaterniond::Identity(), street.street_in_enu};
  for (const Rigid3& cam_from_enu : street.cams_from_enu)
    cams_from_street_.push_back(cam_from_enu * enu_from_street);
}

LightRay StreetTruth::RayFrom(size_t i, const Vector3d& bearing) const {
  const Rigid3& pose = cams_from_street_[i];
  return {pose.Centre(), pose.rotation.conjugate() * bearing};
}

SurfaceHit StreetTruth::TraceFrom(size_t i, const Vector3d& bearing) const {
  return Trace(street_.WorldOf(i), NoTraffic(), RayFrom(i, bearing));
}

SurfaceKind StreetTruth::KindOf(size_t i, const LightRay& ray, const SurfaceHit& hit) const {
  const StreetWorld& world = street_.WorldOf(i);
  if (hit.surface <= SurfaceHit::kGround) return SurfaceKind::kStill;
  if (options_.hardships.wind_m > 0.0 && IsCrown(world, hit)) return SurfaceKind::kMoves;
  constexpr double kPixel_m = 0.01;
  const Solid& solid = world.solids[hit.solid];
  const double glass =
      world.reflection * LookOfSolid(solid, hit.face, hit.point, ray.direction, kPixel_m).glass;
  return glass > kGlass ? SurfaceKind::kGlass : SurfaceKind::kStill;
}

RasterTruth StreetTruth::Of(size_t own, const std::vector<size_t>& others, int face_px) const {
  const EquiangularRaster raster{face_px};
  const StreetMoment moment = MomentOf(street_, options_, own);
  const StreetWorld& world = street_.WorldOf(own);
  RasterTruth truth{.face_px = face_px};
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int row = 0; row < face_px; ++row) {
      for (int column = 0; column < face_px; ++column) {
        const LightRay ray = RayFrom(own, raster.BearingFromPixel(face, row + 0.5, column + 0.5));
        const SurfaceHit hit = Trace(world, NoTraffic(), ray);
        const SurfaceHit now = Trace(moment.World(), moment.traffic, ray);
        const bool sky = hit.surface == SurfaceHit::kSky;
        const bool moves = now.moving || IsCrown(moment.World(), now) != IsCrown(world, hit);
        truth.range_m.push_back(sky ? 0.0F : static_cast<float>(hit.distance_m));
        truth.points.push_back(hit.point.cast<float>());
        truth.normals.push_back(hit.normal.cast<float>());
        truth.kinds.push_back(moves ? SurfaceKind::kMoves : KindOf(own, ray, hit));
        const bool near = !sky && IsJudged(hit.distance_m);
        const bool chosen = row % 4 == 1 && column % 4 == 1;
        truth.counts.push_back(near && chosen && IsSeen(hit, others) ? 1 : 0);
      }
    }
  }
  GrowMoving(raster, truth.kinds);
  return truth;
}

bool StreetTruth::IsSeen(const SurfaceHit& hit, const std::vector<size_t>& others) const {
  return std::ranges::any_of(others, [&](size_t other) {
    const Vector3d in_cam = cams_from_street_[other] * hit.point;
    const double distance_m = in_cam.norm();
    if (!IsJudged(distance_m)) return false;
    const SurfaceHit seen = TraceFrom(other, in_cam / distance_m);
    return seen.surface != SurfaceHit::kSky &&
           std::abs(seen.distance_m - distance_m) < kSamePoint_m;
  });
}

}  // namespace orbweave
