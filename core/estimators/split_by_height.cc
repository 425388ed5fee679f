// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/split_by_height.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kFarther = 8.0;
constexpr double kTelling = 3.0;

bool IsEitherHigh(const BearingPairs& pairs, uint32_t i) {
  return orbweave::IsEitherHigh(pairs.A(i), pairs.B(i));
}

}  // namespace

bool IsHigh(const Vector3d& bearing) { return -bearing.y() > std::sin(kSkyElevation_rad); }

bool IsEitherHigh(const Vector3d& bearing_a, const Vector3d& bearing_b) {
  return IsHigh(bearing_a) || IsHigh(bearing_b);
}

MatchesByHeight SplitByHeight(std::span<const Vector3d> bearings_a,
                              std::span<const Vector3d> bearings_b,
                              std::span<const FeatureMatch> matches) {
  MatchesByHeight split;
  for (const FeatureMatch& match : matches) {
    const bool is_high = IsEitherHigh(bearings_a[match.a], bearings_b[match.b]);
    (is_high ? split.high : split.low).push_back(match);
  }
  return split;
}

double InverseDepth(const Vector3d& a, const Vector3d& b, const Rigid3& b_from_a) {
  const double parallax = std::min(AngleBetween(b_from_a.rotation * a, b), 0.5 * std::numbers::pi);
  const double across = b_from_a.translation.cross(b).norm();
  return across > 0.0 ? std::sin(parallax) / across : std::numeric_limits<double>::infinity();
}

std::vector<uint32_t> WithoutSky(const BearingPairs& pairs,
                                 std::span<const uint32_t> inliers,
                                 const Rigid3& b_from_a,
                                 double max_error_rad) {
  std::vector<double> of_low;
  for (const uint32_t i : inliers) {
    if (!IsEitherHigh(pairs, i)) of_low.push_back(InverseDepth(pairs.A(i), pairs.B(i), b_from_a));
  }
  if (of_low.empty()) return {};
  const double typical = UpperMedian(std::move(of_low));
  if (!(typical > kTelling * max_error_rad)) return {};
  std::vector<uint32_t> kept;
  for (const uint32_t i : inliers) {
    const bool is_far = InverseDepth(pairs.A(i), pairs.B(i), b_from_a) < typical / kFarther ||
                        IsWithinAngle(b_from_a.rotation * pairs.A(i), pairs.B(i), max_error_rad);
    if (!is_far || !IsEitherHigh(pairs, i)) kept.push_back(i);
  }
  return kept;
}

}  // namespace orbweave
