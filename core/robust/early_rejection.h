// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace orbweave {

/// Decides while a model is being scored whether to go on: Wald's sequential probability ratio test
/// (Matas and Chum, Randomized RANSAC with sequential probability ratio test, ICCV 2005), and the
/// certainty that its cost exceeds the best one. Asked between blocks of data in random order.
///
/// With epsilon the share of inliers of the best model so far, but at least the share that makes a
/// model of use, and delta that of a wrong model, the test rejects once (delta/epsilon)^inliers
/// ((1-delta)/(1-epsilon))^outliers > A. A model as good as epsilon is lost with probability below
/// 1/A, whatever delta is.
class EarlyRejection {
 public:
  static constexpr size_t kBlock = 64;  ///< data to score between two questions

  /// `size`: number of data; models with a share of inliers below `min_inlier_share` are of no use
  /// (0: nothing is rejected until Raise was called).
  explicit EarlyRejection(size_t size, double min_inlier_share = 0.0);

  /// A new best model sets the bar.
  void Raise(double cost, uint32_t num_inliers);

  /// Whether a model with `num_inliers` and `cost` over the first `num_seen` data is ruled out.
  [[nodiscard]] bool Rejects(double cost, uint32_t num_inliers, size_t num_seen) const {
    const auto outliers = static_cast<double>(num_seen - num_inliers);
    return cost >= best_cost_ ||
           outliers * log_ratio_outlier_ + num_inliers * log_ratio_inlier_ > kLogA;
  }

 private:
  static constexpr double kLogA = 6.907755278982137;  // A = 1000

  void Expect(double epsilon);

  size_t size_;
  double min_inlier_share_;
  double best_cost_ = std::numeric_limits<double>::infinity();
  double log_ratio_inlier_ = 0.0;
  double log_ratio_outlier_ = 0.0;
};

}  // namespace orbweave
