// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/matched_bearings.h"

#include "core/estimators/two_view_inliers.h"
#include "core/geometry/rotation.h"

namespace orbweave {

BearingPairs MatchedBearings::Arranged(std::span<const FeatureMatch> matches) const {
  return ArrangePairs(a, b, matches, seed);
}

std::vector<uint32_t> MatchedBearings::Agreeing(const BearingPairs& pairs,
                                                const TwoViewGeometry& geometry) const {
  const Rigid3& pose = geometry.b_from_a;
  if (geometry.kind != TwoViewKind::kPureRotation) return InliersOf(pairs, pose, max_error_rad);
  std::vector<uint32_t> inliers;
  for (uint32_t i = 0; i < pairs.Size(); ++i) {
    if (IsWithinAngle(pose.rotation * pairs.A(i), pairs.B(i), max_error_rad)) inliers.push_back(i);
  }
  return inliers;
}

TwoViewGeometry MatchedBearings::Extended(TwoViewGeometry geometry,
                                          std::span<const FeatureMatch> matches) const {
  geometry.num_putative = static_cast<uint32_t>(matches.size());
  const BearingPairs pairs = Arranged(matches);
  SetInliers(Subset(pairs, Agreeing(pairs, geometry)), matches, geometry);
  return geometry;
}

}  // namespace orbweave
