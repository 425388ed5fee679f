// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/features/nearest_two.h"
#include "core/scene/ids.h"

namespace orbweave {

struct AcceptanceLimits {
  double max_ratio = 0.8;     ///< best over second-best distance, below
  double max_distance = 0.7;  ///< of unit descriptors, at most
  bool cross_check = true;    ///< each must pass as the other's best; one-to-one, symmetric
};

/// The nearest neighbours that are good enough, sorted by (a, b). With cross check the result for
/// (b, a) is the same with both sides exchanged; without, only the limits of a's side count.
/// A neighbour without a second best passes the ratio test.
[[nodiscard]] std::vector<FeatureMatch> AcceptMatches(const NearestTwoBothWays& nearest,
                                                      const AcceptanceLimits& limits);

/// A match and how far its best descriptor is from being taken for the second best: the larger of
/// the ratios of both sides, 0 where there is no second. Right matches have smaller ones (Lowe,
/// IJCV 2004, figure 11).
struct RatedMatch {
  FeatureMatch match{};
  double squared_ratio = 0.0;
};

/// The same matches with their ratios.
[[nodiscard]] std::vector<RatedMatch> RateMatches(std::span<const FeatureMatch> matches,
                                                  const NearestTwoBothWays& nearest);

/// Smallest ratios first, by (a, b) where they are equal.
[[nodiscard]] std::vector<FeatureMatch> BestFirst(std::vector<RatedMatch> rated);

}  // namespace orbweave
