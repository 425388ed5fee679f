// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

namespace orbweave {

/// How the errors of one point's bearings go together from one panorama to the next. A detector
/// that sees a thing a little beside its place does so in the next panorama too; points and poses
/// follow such errors, and residuals show only what is left.
///
/// Errors are taken for a first-order process along a track of n images, correlation r^|i-j|. What
/// a fitted point takes off - three unknowns of 2 n equations - is the mean of one coordinate, mean
/// and slope of the other: with P these projections and C the correlations, residuals have the
/// covariance P C P. Independent errors (r = 0) then leave neighbouring residuals a correlation of
/// about -1.5 / n. r is where the model's products of neighbours over its squares are those found.
struct TrackCorrelation {
  static constexpr size_t kMinImages = 4;  ///< shorter tracks leave no more than differences
  static constexpr size_t kMaxImages = 16;
  static constexpr size_t kLengths = kMaxImages + 1;

  std::array<double, kLengths> products{};  ///< [n]: of neighbouring residuals over their sigmas
  std::array<double, kLengths> squares{};
  std::array<double, kLengths> tracks{};  ///< how many

  /// `residuals`: observed less predicted unit vectors, world axes, over their sigmas, in the order
  /// of the images.
  void AddTrack(std::span<const Eigen::Vector3d> residuals);
  void Add(const TrackCorrelation& other);

  /// r, at most 0.9; 0 where errors are independent or too little is known.
  [[nodiscard]] double Correlation() const;

  /// By what variances from independent errors are too small: the errors' variance as r has it over
  /// squares per redundancy, times (1 + r) / (1 - r), the length over which neighbours say the
  /// same.
  [[nodiscard]] double Inflation() const;
};

}  // namespace orbweave
