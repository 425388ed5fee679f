// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/extract_streaming_sift.h"

#include <algorithm>
#include <cmath>

#include "core/features/select_spread.h"
#include "core/features/sift/streaming_sift.h"
#include "core/features/sigma_of_scale.h"

namespace orbweave {
namespace {

/// Narrower panoramas are doubled. At 5376 px models of an indoor flat have observations as many
/// without, but points in 9 % fewer images and 3 % larger residuals: four times faster, and not as
/// good.
constexpr int kWidthToDoubleBelow_px = 6000;

bool IsDoubled(FirstOctave first_octave, int width) {
  if (first_octave == FirstOctave::kAuto) return width < kWidthToDoubleBelow_px;
  return first_octave == FirstOctave::kDoubled;
}

/// Numbers of the positions to be described.
std::vector<uint32_t> ChoosePositions(const StreamingSift& sift,
                                      const EquirectangularCamera& camera,
                                      const UsefulPlaces& places,
                                      size_t max_features) {
  std::vector<ScoredKeypoint> scored;
  std::vector<uint32_t> numbers;
  for (size_t i = 0; i < sift.num_positions(); ++i) {
    const Keypoint keypoint = sift.KeypointOf(i);
    if (!places.Contain(keypoint)) continue;
    scored.push_back({keypoint, sift.ResponseOf(i)});
    numbers.push_back(static_cast<uint32_t>(i));
  }
  std::vector<uint32_t> chosen;
  for (const uint32_t i : SelectSpread(camera, scored, max_features)) chosen.push_back(numbers[i]);
  return chosen;
}

/// The best of all orientations.
DescribedKeypoints Selected(const StreamingSift& sift,
                            const EquirectangularCamera& camera,
                            const std::vector<internal::DescribedPosition>& described,
                            size_t max_features) {
  std::vector<ScoredKeypoint> scored;
  for (const internal::DescribedPosition& d : described) {
    ScoredKeypoint& last = scored.emplace_back(
        ScoredKeypoint{sift.KeypointOf(d.position), sift.ResponseOf(d.position)});
    last.keypoint.orientation_rad = d.orientation_rad;
  }
  DescribedKeypoints selected;
  for (const uint32_t i : SelectSpread(camera, scored, max_features)) {
    selected.keypoints.push_back(scored[i].keypoint);
    selected.sigma_px.push_back(SigmaOfScale_px(scored[i].keypoint.scale_px));
    selected.descriptors.insert(
        selected.descriptors.end(), described[i].descriptor.begin(), described[i].descriptor.end());
  }
  return selected;
}

}  // namespace

absl::StatusOr<DescribedKeypoints> ExtractStreamingSift(const cv::Mat& panorama,
                                                        const UsefulPlaces& places,
                                                        const ExtractOptions& options,
                                                        const StageContext& context) {
  const EquirectangularCamera camera{.width_px = panorama.cols, .height_px = panorama.rows};
  const auto max_features = static_cast<size_t>(options.max_features);
  StreamingSift sift(
      panorama,
      {.thresholds = {.contrast = options.contrast_threshold, .edge = options.edge_threshold},
       .doubled = IsDoubled(options.first_octave, panorama.cols),
       .first_y = places.first_y(),
       .end_y = places.end_y()});
  ORBWEAVE_RETURN_IF_ERROR(sift.Detect(context));
  const std::vector<uint32_t> chosen = ChoosePositions(sift, camera, places, max_features);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<internal::DescribedPosition> described,
                            sift.Describe(chosen, context));
  return Selected(sift, camera, described, max_features);
}

}  // namespace orbweave
