// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/drawing/sphere_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbweave {
namespace {

constexpr double kStep_rad = 0.5 * std::numbers::pi / 180.0;

/// Appends `pixel`, and where it lies beyond the seam of its predecessor begins another curve; both
/// get the other's end on their own side of the border.
void Append(const Eigen::Vector2d& pixel, double width_px, std::vector<PixelCurve>& curves) {
  if (curves.empty()) curves.emplace_back();
  if (!curves.back().empty()) {
    const Eigen::Vector2d before = curves.back().back();
    const double jump_px = pixel.x() - before.x();
    if (std::abs(jump_px) > 0.5 * width_px) {
      const Eigen::Vector2d shift(jump_px > 0.0 ? -width_px : width_px, 0.0);
      curves.back().push_back(pixel + shift);
      curves.push_back({before - shift});
    }
  }
  curves.back().push_back(pixel);
}

}  // namespace

std::vector<PixelCurve> SphereCurve(const EquirectangularCamera& camera,
                                    const Eigen::Vector3d& from,
                                    const Eigen::Vector3d& along,
                                    double length_rad) {
  const int num_steps = std::max(1, static_cast<int>(std::ceil(length_rad / kStep_rad)));
  std::vector<PixelCurve> curves;
  for (int i = 0; i <= num_steps; ++i) {
    const double angle = length_rad * i / num_steps;
    const Eigen::Vector3d bearing = std::cos(angle) * from + std::sin(angle) * along;
    Append(camera.PixelFromBearing(bearing), camera.width_px, curves);
  }
  return curves;
}

}  // namespace orbweave
