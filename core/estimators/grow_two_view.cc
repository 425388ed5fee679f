// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/grow_two_view.h"

#include <vector>

#include "core/estimators/bearing_pairs.h"
#include "core/estimators/split_by_height.h"
#include "core/estimators/split_by_motion.h"
#include "core/estimators/two_view_inliers.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kHardlyAny = 0.1;  // of the inliers: fewer were not taken for the scene

bool IsHardlyAny(size_t some, size_t all) {
  return static_cast<double>(some) < kHardlyAny * static_cast<double>(all);
}

/// Some pairs, and those among them that are sure not to be sky; all where that cannot be told.
std::vector<uint32_t> BelowSky(const BearingPairs& pairs,
                               const Rigid3& b_from_a,
                               double max_error_rad) {
  std::vector<uint32_t> all = AllOf(pairs);
  std::vector<uint32_t> kept = WithoutSky(pairs, all, b_from_a, max_error_rad);
  return kept.empty() ? all : kept;
}

}  // namespace

TwoViewGeometry GrowTwoView(const TwoViewGeometry& geometry,
                            std::span<const Vector3d> bearings_a,
                            std::span<const Vector3d> bearings_b,
                            std::span<const FeatureMatch> matches,
                            double max_error_rad,
                            uint64_t seed) {
  const auto arranged = [&](std::span<const FeatureMatch> some) {
    return ArrangePairs(bearings_a, bearings_b, some, seed);
  };
  const auto by_motion = [&](std::span<const FeatureMatch> some) {
    return SplitByMotion(bearings_a, bearings_b, some, max_error_rad);
  };
  const size_t num_inliers = geometry.inliers.size();
  std::vector<FeatureMatch> likely(matches.begin(), matches.end());
  if (IsHardlyAny(by_motion(geometry.inliers).fixed.size(), num_inliers))
    likely = by_motion(matches).moved;

  BearingPairs pairs = arranged(likely);
  const size_t num_low =
      BelowSky(arranged(geometry.inliers), geometry.b_from_a, max_error_rad).size();
  if (IsHardlyAny(num_inliers - num_low, num_inliers))
    pairs = Subset(pairs, BelowSky(pairs, geometry.b_from_a, max_error_rad));

  const Rigid3 pose = RefinePose(
      pairs, InliersOf(pairs, geometry.b_from_a, max_error_rad), geometry.b_from_a, max_error_rad);
  const ResolvedPose grown =
      RefineToConvergence(pairs, {pose, InliersOf(pairs, pose, max_error_rad)}, max_error_rad);
  if (grown.inliers.size() <= num_inliers) return geometry;
  TwoViewGeometry result = geometry;
  result.b_from_a = grown.b_from_a;
  SetInliers(Subset(pairs, grown.inliers), likely, result);
  return result;
}

}  // namespace orbweave
