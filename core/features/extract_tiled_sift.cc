// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/extract_tiled_sift.h"

#include <algorithm>
#include <cmath>

#include "core/features/select_spread.h"
#include "core/features/sift_tiles.h"
#include "core/features/sigma_of_scale.h"

namespace orbweave {
namespace {

std::vector<SiftCandidate> Selected(const cv::Mat& panorama,
                                    const std::vector<SiftCandidate>& candidates,
                                    size_t max_features) {
  std::vector<ScoredKeypoint> scored;
  for (const SiftCandidate& candidate : candidates)
    scored.push_back({candidate.keypoint, candidate.response});
  std::vector<SiftCandidate> selected;
  for (const uint32_t i :
       SelectSpread({.width_px = panorama.cols, .height_px = panorama.rows}, scored, max_features))
    selected.push_back(candidates[i]);
  return selected;
}

}  // namespace

absl::StatusOr<DescribedKeypoints> ExtractTiledSift(const cv::Mat& panorama,
                                                    const UsefulPlaces& places,
                                                    const ExtractOptions& options,
                                                    const StageContext& context) {
  const std::vector<SiftLevel> levels =
      BuildSiftLevels(panorama,
                      static_cast<int>(std::floor(places.first_y())),
                      static_cast<int>(std::ceil(places.end_y())),
                      options.tile_size_px);
  ORBWEAVE_ASSIGN_OR_RETURN(
      std::vector<SiftCandidate> candidates,
      DetectSift(levels,
                 {.contrast = options.contrast_threshold, .edge = options.edge_threshold},
                 context));
  std::erase_if(candidates, [&](const auto& c) { return !places.Contain(c.keypoint); });
  candidates = Selected(panorama, candidates, static_cast<size_t>(options.max_features));
  DescribedKeypoints described;
  ORBWEAVE_ASSIGN_OR_RETURN(described.descriptors, DescribeSift(levels, candidates, context));
  for (const SiftCandidate& candidate : candidates) {
    described.keypoints.push_back(candidate.keypoint);
    described.sigma_px.push_back(SigmaOfScale_px(candidate.keypoint.scale_px));
  }
  return described;
}

}  // namespace orbweave
