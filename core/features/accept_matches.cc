// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/accept_matches.h"

namespace orbweave {
namespace {

/// Squared length of a unit descriptor: RootSIFT times 512.
constexpr double kUnitSquared = 512.0 * 512.0;

bool IsGood(const NearestTwo& nearest, const AcceptanceLimits& limits) {
  const double best = nearest.best;
  return nearest.best < kNoDistance &&
         best <= limits.max_distance * limits.max_distance * kUnitSquared &&
         (nearest.second == kNoDistance ||
          best < limits.max_ratio * limits.max_ratio * nearest.second);
}

}  // namespace

std::vector<FeatureMatch> AcceptMatches(const NearestTwoBothWays& nearest,
                                        const AcceptanceLimits& limits) {
  std::vector<FeatureMatch> matches;
  for (FeatureIndex a = 0; a < nearest.of_a.size(); ++a) {
    const NearestTwo& of_a = nearest.of_a[a];
    if (!IsGood(of_a, limits)) continue;
    const NearestTwo& of_b = nearest.of_b[of_a.index];
    if (limits.cross_check && (of_b.index != a || !IsGood(of_b, limits))) continue;
    matches.push_back({a, of_a.index});
  }
  return matches;
}

}  // namespace orbweave
