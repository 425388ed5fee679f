// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/equirectangular_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbweave {

using std::numbers::pi;

Eigen::Vector3d EquirectangularCamera::BearingFromPixel(const Eigen::Vector2d& pixel) const {
  const double longitude = (pixel.x() / width_px - 0.5) * 2.0 * pi;
  const double latitude = (pixel.y() / height_px - 0.5) * pi;  // positive downwards, like y
  const double cos_latitude = std::cos(latitude);
  return {
      cos_latitude * std::sin(longitude), std::sin(latitude), cos_latitude * std::cos(longitude)};
}

Eigen::Vector2d EquirectangularCamera::PixelFromBearing(const Eigen::Vector3d& bearing) const {
  // atan2 instead of asin: as exact at the poles as at the equator.
  const double latitude = std::atan2(bearing.y(), std::hypot(bearing.x(), bearing.z()));
  double column = (std::atan2(bearing.x(), bearing.z()) / (2.0 * pi) + 0.5) * width_px;
  if (column >= width_px) column -= width_px;
  return {column, (0.5 + latitude / pi) * height_px};
}

double EquirectangularCamera::AngleFromPixels(double pixels) const {
  return 2.0 * pi / std::max(width_px, height_px) * pixels;
}

double EquirectangularCamera::PixelsFromAngle(double angle_rad) const {
  return angle_rad * std::max(width_px, height_px) / (2.0 * pi);
}

}  // namespace orbweave
