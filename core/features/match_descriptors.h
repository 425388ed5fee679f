// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/features/match_options.h"
#include "core/features/nearest_two.h"
#include "core/scene/features.h"
#include "core/scene/ids.h"

namespace orbweave {

/// Nearest-neighbour matches of two panoramas by descriptor distance, sorted by (a, b). With cross
/// check both directions must pass all tests, so exchanging the panoramas exchanges the result.
/// Empty when either has no descriptors. The same on every machine: integer arithmetic.
[[nodiscard]] std::vector<FeatureMatch> MatchDescriptors(const Features& a,
                                                         const Features& b,
                                                         const MatchOptions& options);

/// The same from nearest neighbours that were found already.
[[nodiscard]] std::vector<FeatureMatch> AcceptNearest(const NearestTwoBothWays& nearest,
                                                      const MatchOptions& options);

/// Matches of nearest neighbours near epipolar planes (NearestInPlanes): by `guided_max_ratio`,
/// `max_distance` and cross check. There are few candidates in a plane, so an unmatched feature
/// easily finds one by chance: the ratio is what keeps such matches out. Sorted by (a, b),
/// one-to-one.
[[nodiscard]] std::vector<FeatureMatch> AcceptGuided(const NearestTwoBothWays& nearest,
                                                     const MatchOptions& options);

}  // namespace orbweave
