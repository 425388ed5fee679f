// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/find_rival_direction.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <vector>

#include "core/base/random.h"
#include "core/estimators/bearing_pairs.h"
#include "core/estimators/two_view_inliers.h"
#include "core/geometry/rotation.h"
#include "core/geometry/turned_two_point.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kFewest = 8;
/// Two of a fifth of the matches: 1 - (1 - 0.2^2)^200 = 0.9997.
constexpr int kTrials = 200;

std::vector<FeatureMatch> MovedElsewise(std::span<const Vector3d> bearings_a,
                                        std::span<const Vector3d> bearings_b,
                                        std::span<const FeatureMatch> matches,
                                        const TwoViewGeometry& geometry,
                                        double max_error_rad) {
  std::vector<FeatureMatch> moved;
  std::ranges::copy_if(matches, std::back_inserter(moved), [&](const FeatureMatch& match) {
    return !std::ranges::binary_search(geometry.inliers, match) &&
           HasClearlyMoved(
               geometry.b_from_a.rotation, bearings_a[match.a], bearings_b[match.b], max_error_rad);
  });
  return moved;
}

}  // namespace

MatchEvidence FindRivalDirection(std::span<const Vector3d> bearings_a,
                                 std::span<const Vector3d> bearings_b,
                                 std::span<const FeatureMatch> matches,
                                 const TwoViewGeometry& geometry,
                                 double max_error_rad,
                                 uint64_t seed) {
  const std::vector<FeatureMatch> moved =
      MovedElsewise(bearings_a, bearings_b, matches, geometry, max_error_rad);
  if (moved.size() < kFewest) return {};
  const BearingPairs pairs = ArrangePairs(bearings_a, bearings_b, moved, seed);
  Random random(seed);
  std::optional<Rigid3> best;
  size_t most = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const uint32_t first = random.Index(static_cast<uint32_t>(pairs.Size()));
    const uint32_t second = random.Index(static_cast<uint32_t>(pairs.Size()));
    const std::array a = {pairs.A(first), pairs.A(second)};
    const std::array b = {pairs.B(first), pairs.B(second)};
    const std::optional<Rigid3> pose = SolveTurnedTwoPoint(geometry.b_from_a.rotation, a, b);
    if (!pose || AngleBetween(pose->translation, geometry.b_from_a.translation) < kOneDirection_rad)
      continue;
    const size_t agreeing = InliersOf(pairs, *pose, max_error_rad).size();
    if (agreeing <= most) continue;
    most = agreeing;
    best = pose;
  }
  return best ? EvidenceOf(pairs, *best, max_error_rad) : MatchEvidence{};
}

}  // namespace orbweave
