// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/base/stage_context.h"
#include "core/estimators/two_view_options.h"
#include "core/features/match_options.h"
#include "core/features/pair_side.h"
#include "core/scene/pair_candidates.h"
#include "core/scene/predicted_pose.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// What a job knows of a pair beside its images.
struct GivenPair {
  /// Putative matches from outside; when not empty, descriptors are not looked at.
  std::vector<FeatureMatch> matches{};
  std::optional<PredictedPose> predicted{};
};

/// The verified matches of two panoramas, by a ladder (MatchRung): nearest descriptors and geometry
/// on rays, first of the largest features alone (matching.largest_first), of all where these leave
/// doubt, also together with what they predict; where all are no evidence, samples of cameras that
/// stand upright. What a geometry
/// predicts is then looked for along its epipolar planes (matching.guided), against decoys
/// (MatchAgainstDecoys): matches that the ratio test lost are recovered, and a pair whose few
/// matches are no evidence by themselves is kept where those that they predict are; then
/// log10_false_alarms is the sum of both, since new matches had no part in finding the geometry.
/// With a predicted pose samples are of two matches with its rotation, and nothing else is tried.
[[nodiscard]] absl::StatusOr<TwoViewGeometry> MatchImagePair(ImagePair pair,
                                                             const PairSide& a,
                                                             const PairSide& b,
                                                             const GivenPair& given,
                                                             const MatchOptions& match_options,
                                                             const TwoViewOptions& two_view_options,
                                                             const StageContext& context);

/// What later decisions need of a verified pair (MatchedPair).
[[nodiscard]] MatchedPair WithoutMatches(const TwoViewGeometry& geometry,
                                         const PairSide& a,
                                         const PairSide& b,
                                         const TwoViewOptions& two_view_options);

}  // namespace orbweave
