// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/match_descriptors.h"

#include "core/features/accept_matches.h"
#include "core/features/find_nearest_two.h"

namespace orbweave {

std::vector<FeatureMatch> MatchDescriptors(const Features& a,
                                           const Features& b,
                                           const MatchOptions& options) {
  if (a.descriptors.empty() || b.descriptors.empty()) return {};
  return AcceptNearest(FindNearestTwo(a.descriptors, b.descriptors), options);
}

std::vector<FeatureMatch> AcceptNearest(const NearestTwoBothWays& nearest,
                                        const MatchOptions& options) {
  return AcceptMatches(nearest, {options.max_ratio, options.max_distance, options.cross_check});
}

std::vector<FeatureMatch> AcceptGuided(const NearestTwoBothWays& nearest,
                                       const MatchOptions& options) {
  return AcceptMatches(nearest, {options.guided_max_ratio, options.max_distance, true});
}

}  // namespace orbweave
