// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace orbweave {

/// Facade views of a panorama: eight, each turned by 45 degrees.
inline constexpr int kNumFacadeViews = 8;

/// What a pinhole camera in the panorama's place sees that looks level at azimuth 45 deg x number
/// (0 is the image centre, clockwise from above). A wall that stands parallel to its image plane is
/// seen there in its true shape, at one scale however far along it one looks, and the same from all
/// places along the wall: what a car passes at 8 m and sees again 12 m on is tilted by 56 degrees
/// in the panorama and only shifted here. (The idea of Micusik and Kosecka, CVPR 2009, and, with
/// planes that are found first, of Wu, Clipp, Li, Frahm and Pollefeys, CVPR 2008.)
///
/// 60 degrees to both sides, 45 degrees up and 35 down at the middle. Pixels are those of the
/// panorama at the middle, corner convention; axes as of EquirectangularCamera.
struct FacadeView {
  int number = 0;         ///< from 0 on
  double focal_px = 0.0;  ///< panorama's width over 2 pi

  [[nodiscard]] int Width() const;
  [[nodiscard]] int Height() const;
  /// Unit bearing in the panorama's camera frame.
  [[nodiscard]] Eigen::Vector3d BearingFromPixel(const Eigen::Vector2d& pixel) const;
  /// Square root of the solid angle of a pixel there over that of one at the middle:
  /// (1 + X^2 + Y^2)^(-3/4) with X, Y in focal lengths from the middle.
  [[nodiscard]] double ScaleAt(const Eigen::Vector2d& pixel) const;
};

}  // namespace orbweave
