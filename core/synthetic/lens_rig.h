// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace orbweave {

/// Six lenses, one forward, four more every 72 degrees about the vertical, one up. A bearing of the
/// panorama belongs to the lens whose axis is nearest, without blending; the pictures are stitched
/// as if all were 20 m away, so that only what is there is free of parallax.
struct LensRig {
  double offset_m = 0.0;    ///< of each lens along its axis from the middle
  double vignetting = 0.0;  ///< share of light lost 45 degrees off a lens's axis

  static constexpr double kStitchedAt_m = 20.0;

  /// Axis in the camera frame (x right, y down, z forward) of the lens that sees `bearing`.
  [[nodiscard]] static Eigen::Vector3d AxisFor(const Eigen::Vector3d& bearing);
  /// Gain of a pixel, 1 on the axis: 1 - 2 vignetting sin^2(angle), at least 0.1.
  [[nodiscard]] double Gain(const Eigen::Vector3d& bearing) const;
};

}  // namespace orbweave
