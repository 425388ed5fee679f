// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Pairs of registered images, in order of the graph's pairs.
struct JudgedPairs {
  std::vector<ImagePair> explained{};
  std::vector<ImagePair> contradicted{};
  /// Of those the ones whose own matches do not lie in the planes of the model's pose: they lead
  /// elsewhere than the model, or turn otherwise.
  std::vector<ImagePair> askew{};
};

/// Holds verified pairs against the model that was made of them. Evidence are the matches whose two
/// features both show a point. One is explained when it is the same point, or when the point of one
/// feature is seen by the other image where the other feature is, within twice
/// options.max_error_px: tracks of one thing that never met do not count against a model, and
/// unlike an epipolar plane a point tells a facade from its likeness further down a straight
/// street.
///
/// A pair is *explained* when a third of its matches are, and more than chance leaves: the model's
/// own pose of the two images is verified by them, whatever else the pair's matches show (moving
/// things, patterns that repeat within one room). It is *contradicted* when no more are than chance
/// or clearly fewer than a third (by two standard deviations of the count), there are at least
/// options.min_inliers of them, and those the model tears apart are in several places of both
/// panoramas: one poster, one bus or one plane that fits several poses is no evidence. Places that
/// look alike make such pairs; in a model folded onto itself the right pairs are among them.
///
/// An image that stands on the wrong side of its neighbour, or far from where it was, takes the
/// points of the pair away and with them this evidence. So a pair is contradicted too when it has
/// 2 options.min_inliers matches, as few of all of them lie in the epipolar planes of the model's
/// pose and in front of both images, and the others are in several places of both; and, whatever
/// the few say that show points, when clearly fewer than three fifths of those in the planes of its
/// own pose lie in the model's. Pairs of one centre or one plane are not asked, and pairs that are
/// wrong in themselves (MisleadingPairs) are no witnesses. All others are neither.
[[nodiscard]] JudgedPairs JudgePairs(const MappingState& state, const MappingOptions& options);

/// The contradicted ones.
[[nodiscard]] std::vector<ImagePair> FindContradictedPairs(const MappingState& state,
                                                           const MappingOptions& options);

}  // namespace orbweave
