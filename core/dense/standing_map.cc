// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/standing_map.h"

#include <cmath>
#include <numbers>

#include "core/base/status.h"

namespace orbweave {
namespace {

/// Sigma in classes of sqrt 2, by exact operations.
int SigmaClass(float sigma) {
  int exponent = 0;
  const float mantissa = std::frexp(sigma, &exponent);
  return 2 * exponent + (mantissa >= static_cast<float>(0.5 * std::numbers::sqrt2) ? 1 : 0);
}

}  // namespace

StandingMap::StandingMap(const PosedDepthMap& posed, const Eigen::Vector3d& origin)
    : image_(posed.image),
      map_(posed.map),
      bearings_({posed.map->face_px}),
      world_from_cam_(posed.cam_from_world.rotation.conjugate().toRotationMatrix()),
      centre_(posed.cam_from_world.Centre() - origin) {
  const size_t pixels = bearings_.raster().NumPixels();
  ORBWEAVE_CHECK(map_->range_m.size() == pixels && map_->normals.size() == pixels &&
                 map_->sigma_m.size() == pixels && map_->views.size() == pixels &&
                 map_->flags.size() == pixels);
}

bool StandingMap::IsChecked(size_t pixel) const {
  const float range = map_->range_m[pixel];
  const float sigma = map_->sigma_m[pixel];
  return (map_->flags[pixel] & kDepthChecked) != 0 && range > 0.0F && std::isfinite(range) &&
         sigma > 0.0F && std::isfinite(sigma);
}

PixelSample StandingMap::SampleOf(size_t pixel) const {
  PixelSample sample;
  sample.ray = world_from_cam_ * bearings_.Of(pixel);
  sample.point = centre_ + static_cast<double>(map_->range_m[pixel]) * sample.ray;
  sample.normal = world_from_cam_ * DecodeNormal(map_->normals[pixel]).cast<double>();
  sample.sigma_m = static_cast<double>(map_->sigma_m[pixel]);
  sample.rank = {SigmaClass(map_->sigma_m[pixel]), image_, pixel};
  return sample;
}

void StandingMap::Around(const Eigen::Vector3d& direction,
                         double limit_px,
                         std::vector<size_t>& pixels) const {
  bearings_.Around(world_from_cam_.transpose() * direction, limit_px, pixels);
}

double StandingMap::Footprint(const Eigen::Vector3d& point) const {
  return (point - centre_).norm() * PixelAngle();
}

}  // namespace orbweave
