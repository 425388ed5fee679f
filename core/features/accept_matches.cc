// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/accept_matches.h"

#include <algorithm>
#include <tuple>

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

double SquaredRatio(const NearestTwo& nearest) {
  if (nearest.second == kNoDistance || nearest.second == 0) return 0.0;
  return static_cast<double>(nearest.best) / nearest.second;
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

std::vector<RatedMatch> RateMatches(std::span<const FeatureMatch> matches,
                                    const NearestTwoBothWays& nearest) {
  std::vector<RatedMatch> rated;
  rated.reserve(matches.size());
  for (const FeatureMatch& match : matches) {
    rated.push_back(
        {match,
         std::max(SquaredRatio(nearest.of_a[match.a]), SquaredRatio(nearest.of_b[match.b]))});
  }
  return rated;
}

std::vector<FeatureMatch> BestFirst(std::vector<RatedMatch> rated) {
  std::ranges::sort(rated, [](const RatedMatch& x, const RatedMatch& y) {
    return std::tie(x.squared_ratio, x.match) < std::tie(y.squared_ratio, y.match);
  });
  std::vector<FeatureMatch> matches;
  matches.reserve(rated.size());
  for (const RatedMatch& one : rated) matches.push_back(one.match);
  return matches;
}

}  // namespace orbweave
