// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace orbweave {

/// Mean sideways residual by where in the panorama it is. Noise averages out; what stays repeats in
/// every panorama: lenses of a head that do not share a centre, stitching, another projection.
struct ResidualPattern {
  static constexpr size_t kSectors = 36;  ///< of azimuth, atan2(x, z) in the camera frame

  std::array<double, kSectors> sum_px{};
  std::array<uint32_t, kSectors> count{};

  /// `bearing` as observed, `ray` as predicted, both unit, camera frame; `px_per_rad` at the
  /// equator.
  void Add(const Eigen::Vector3d& bearing, const Eigen::Vector3d& ray, double px_per_rad);
  void Add(const ResidualPattern& other);

  /// The largest mean that noise of `rms_px` does not explain (six standard deviations); 0: none.
  [[nodiscard]] double LargestPx(double rms_px) const;
};

}  // namespace orbweave
