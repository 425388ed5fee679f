// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/features/match_options.h"
#include "core/features/nearest_two.h"
#include "core/geometry/rigid3.h"
#include "core/scene/features.h"
#include "core/scene/ids.h"

namespace orbweave {

/// What a geometry predicts and descriptors confirm.
struct PredictedMatches {
  std::vector<FeatureMatch> matches{};  ///< sorted by (a, b), one-to-one
  /// log10 of the probability that wrong planes find as many matches that were not known before.
  double log10_chance = 0.0;
};

/// Matches along the epipolar planes of `b_from_a` (MatchGuided) that are better than chance. In a
/// plane there are a hundred candidates, so that one feature in a hundred finds a partner by
/// chance: of 10,000 features a hundred, which on a street seen from far apart is more than are
/// right. How many are wrong is measured by decoys, planes of geometries that are surely wrong
/// (turned about the baseline, and about the vertical of camera b), as in the target-decoy searches
/// of proteomics (Elias and Gygi, Nature Methods 2007). Matches are ranked by their distance over
/// the distance of the nearest descriptor in the whole other image, which `nearest` holds; the
/// longest list is returned of which options.guided_max_wrong_share is wrong at most, empty where
/// there is none. A match that decoys and target share is no decoy's.
///
/// `known`: matches that led to the geometry, sorted. For log10_chance the others alone count,
/// those that are nearest in the whole image and speak for themselves (PlacePairs), as the tail of
/// a Poisson distribution whose mean is that of the decoy that finds most, and one more.
[[nodiscard]] PredictedMatches MatchAgainstDecoys(const Features& a,
                                                  const Features& b,
                                                  const Rigid3& b_from_a,
                                                  double max_error_rad,
                                                  const NearestTwoBothWays& nearest,
                                                  std::span<const FeatureMatch> known,
                                                  const MatchOptions& options);

}  // namespace orbweave
