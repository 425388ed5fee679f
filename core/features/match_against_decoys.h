// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/features/match_options.h"
#include "core/features/nearest_two.h"
#include "core/features/pair_side.h"
#include "core/geometry/rigid3.h"
#include "core/scene/ids.h"

namespace orbweave {

/// What a geometry predicts and descriptors confirm.
struct PredictedMatches {
  std::vector<FeatureMatch> matches{};  ///< sorted by (a, b), one-to-one
  /// log10 of the probability that wrong planes find as many matches that were not known before.
  double log10_chance = 0.0;
};

/// Matches along the epipolar planes of `b_from_a` (AcceptGuided) that are better than chance. In a
/// plane there are a hundred candidates, so that one feature in a hundred finds a partner by
/// chance: of 10,000 features a hundred, which on a street seen from far apart is more than are
/// right. How many are wrong is measured by decoys, planes of geometries that are surely wrong
/// (turned about the baseline, and about the vertical of camera b), as in the target-decoy searches
/// of proteomics (Elias and Gygi, Nature Methods 2007). Matches are ranked by their distance over
/// the distance of the nearest descriptor of either feature; the longest list is returned of which
/// options.guided_max_wrong_share is wrong at most, empty where there is none. A match that decoys
/// and target share is no decoy's. The nearest are those of the whole images, which `nearest`
/// holds; nullptr: those in the planes of target and decoys together, which then compete.
///
/// `known`: matches that led to the geometry, sorted. For log10_chance the others alone count,
/// those that have nothing nearer and speak for themselves (PlacePairs), as the tail of a Poisson
/// distribution whose mean is that of the decoy that finds most, and one more. nullopt: 0.
/// Both sides have descriptors, b_from_a a translation.
[[nodiscard]] PredictedMatches MatchAgainstDecoys(
    const PairSide& a,
    const PairSide& b,
    const Rigid3& b_from_a,
    double max_error_rad,
    const NearestTwoBothWays* nearest,
    std::optional<std::span<const FeatureMatch>> known,
    const MatchOptions& options);

}  // namespace orbweave
