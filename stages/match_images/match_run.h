// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/artifacts/recipes.h"
#include "core/base/stage_context.h"
#include "core/pipeline/blob_access.h"
#include "stages/match_images/match_image_pair.h"

namespace orbweave {

struct MatchedRun {
  std::vector<TwoViewGeometry> verified{};  ///< of the pairs that have a geometry, in their order
  std::vector<MatchedPair> matched{};       ///< the same without matches
  std::string report_json{};
};

/// MatchImagePair for each pair of a recipe, without what goes along with the cameras
/// (HideCarrier). A pair's seed follows from the content of its two images: it gets the same answer
/// in any task. InvalidArgument: a match names a keypoint that its image does not have. Errors of
/// `blobs`.
[[nodiscard]] absl::StatusOr<MatchedRun> MatchRun(const MatchRecipe& recipe,
                                                  BlobAccess& blobs,
                                                  const MatchOptions& match_options,
                                                  const TwoViewOptions& two_view_options,
                                                  const StageContext& context);

}  // namespace orbweave
