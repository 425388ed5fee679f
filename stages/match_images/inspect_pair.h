// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/estimators/two_view_options.h"
#include "core/features/match_options.h"
#include "core/graph/pair_options.h"
#include "core/scene/image_manifest.h"
#include "stages/match_images/match_image_pair.h"

namespace orbweave {

/// What matching made of a pair.
enum class PairVerdict {
  kVerified,  ///< the geometry is accepted by the job's options
  kRejected,  ///< the geometry is the best there is, with less support than the options ask for
  kNothing,   ///< too few matches, or none that have a geometry in common
};

/// A pair looked at again.
struct PairInspection {
  PairVerdict verdict = PairVerdict::kNothing;
  std::vector<FeatureMatch> putative{};  ///< by descriptors, or given; sorted
  TwoViewGeometry geometry{};
  /// Inliers that are not among the putative matches: matches of walls in their true shape
  /// (MatchFacades) ...
  uint32_t num_on_facades = 0;
  uint32_t num_guided = 0;          ///< ... and those won by matching again under the geometry
  double residual_px_median = 0.0;  ///< SymmetricEpipolarAngle of the inliers, at a's equator
  double spread_in_b = 0.0;         ///< as geometry.spread, in b

  /// Putative matches that are no inliers, sorted.
  [[nodiscard]] std::vector<FeatureMatch> Outliers() const;
};

/// Matches the pair as the job did, or would have done: `verified` is what the job has of it.
/// Without, MatchImagePair decides; where that accepts nothing, the putative matches are asked for
/// the best geometry that any eight of them support. Arguments as of MatchImagePair.
[[nodiscard]] absl::StatusOr<PairInspection> InspectPair(
    ImagePair pair,
    const PairSide& a,
    const PairSide& b,
    const std::vector<FeatureMatch>& given,
    const std::optional<TwoViewGeometry>& verified,
    const MatchOptions& match_options,
    const TwoViewOptions& two_view_options,
    const StageContext& context);

/// Why the pair was not to be tried, in a sentence without a full stop: held back along a strong
/// chain (ChooseWiderPairs), or how far apart in the sequence, and by GNSS, against the options.
[[nodiscard]] std::string WhyNotSelected(const ImageManifest& manifest,
                                         ImagePair pair,
                                         const PairOptions& options);

}  // namespace orbweave
