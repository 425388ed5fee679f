// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace orbweave {

/// The equirectangular (360 x 180 degrees) camera of equations (1)-(3): axes x right, y down,
/// z forward (image centre); the same as COLMAP's EQUIRECTANGULAR (model id 17).
///
///   column = (atan2(x, z) / 2pi + 1/2) W      row = (1/2 + asin(y) / pi) H
///
/// Pixel (0, 0) is the corner of the first pixel, not its middle; columns are periodic with W.
struct EquirectangularCamera {
  int width_px = 0;
  int height_px = 0;

  friend bool operator==(const EquirectangularCamera&, const EquirectangularCamera&) = default;

  /// Unit bearing in the camera frame of a pixel position.
  [[nodiscard]] Eigen::Vector3d BearingFromPixel(const Eigen::Vector2d& pixel) const;
  /// Pixel position of a non-zero vector: column in [0, W), row in [0, H].
  [[nodiscard]] Eigen::Vector2d PixelFromBearing(const Eigen::Vector3d& bearing) const;
  /// Equation (8): an angle that covers `pixels` at the equator, e_a = 2pi / max(W, H) e_p.
  [[nodiscard]] double AngleFromPixels(double pixels) const;
  [[nodiscard]] double PixelsFromAngle(double angle_rad) const;
};

}  // namespace orbweave
