// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/robust/early_rejection.h"

#include <algorithm>
#include <cmath>

namespace orbweave {
namespace {

constexpr double kDelta = 0.02;       // share of inliers of a wrong model
constexpr double kMinEpsilon = 0.04;  // below, good and wrong models cannot be told apart early
constexpr double kMaxEpsilon = 0.95;  // keeps one outlier from deciding

}  // namespace

EarlyRejection::EarlyRejection(size_t size, double min_inlier_share)
    : size_(size), min_inlier_share_(min_inlier_share) {
  Expect(min_inlier_share);
}

void EarlyRejection::Raise(double cost, uint32_t num_inliers) {
  best_cost_ = cost;
  Expect(
      std::max(min_inlier_share_, static_cast<double>(num_inliers) / static_cast<double>(size_)));
}

void EarlyRejection::Expect(double epsilon) {
  if (epsilon < kMinEpsilon) return;
  epsilon = std::min(epsilon, kMaxEpsilon);
  log_ratio_inlier_ = std::log(kDelta / epsilon);
  log_ratio_outlier_ = std::log((1.0 - kDelta) / (1.0 - epsilon));
}

}  // namespace orbweave
