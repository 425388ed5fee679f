// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "core/scene/cross_check.h"

namespace orbweave {

/// Mean residual by where in the panorama it is. Noise averages out; what stays repeats in every
/// panorama: lenses of a head that do not share a centre, stitching, another projection (over
/// azimuth), a panorama that is too tall or too flat for its width (over latitude).
struct ResidualPattern {
  static constexpr size_t kSectors = 36;  ///< of azimuth, atan2(x, z) in the camera frame
  static constexpr size_t kBands = 18;    ///< of latitude, from the lower pole to the upper

  std::array<double, kSectors> sum_px{};     ///< sideways
  std::array<double, kSectors> sum_up_px{};  ///< upwards
  std::array<uint32_t, kSectors> count{};
  std::array<double, kBands> band_up_px{};
  std::array<uint32_t, kBands> band_count{};

  /// `bearing` as observed, `ray` as predicted, both unit, camera frame; `px_per_rad` at the
  /// equator.
  void Add(const Eigen::Vector3d& bearing, const Eigen::Vector3d& ray, double px_per_rad);
  void Add(const ResidualPattern& other);

  /// The largest mean over azimuth, sideways or upwards, that noise of `rms_px` does not explain
  /// (six standard deviations); 0: none.
  [[nodiscard]] double LargestOverAzimuthPx(double rms_px) const;
  /// The same over latitude, upwards.
  [[nodiscard]] double LargestOverLatitudePx(double rms_px) const;
  /// The larger of both.
  [[nodiscard]] double LargestPx(double rms_px) const;
};

/// "residual_pattern": LargestPx, which bends a model without showing in its sigmas.
[[nodiscard]] CrossCheck CheckResidualPattern(const ResidualPattern& pattern, double rms_px);

}  // namespace orbweave
