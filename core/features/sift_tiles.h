// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "core/base/stage_context.h"
#include "core/features/panorama_tiles.h"
#include "core/features/sift_thresholds.h"
#include "core/scene/features.h"

namespace orbweave {

/// A panorama at one resolution, cut in tiles, and the octaves that are looked for there.
/// Octave o holds the scales 1.6 x 2^o ... 1.6 x 2^(o+1) pixels; the first is -1 (the image
/// doubled).
struct SiftLevel {
  cv::Mat pixels{};  ///< 8-bit BGR
  std::vector<Tile> tiles{};
  cv::Point2d panorama_from_level{1.0, 1.0};  ///< column and row factors, corner convention
  int last_octave = 0;
};

/// An extremum of the difference of Gaussians with one of its orientations.
struct SiftCandidate {
  Keypoint keypoint{};    ///< in the panorama
  float response = 0.0F;  ///< contrast, for greys in 0 ... 1
  uint32_t level = 0;
  uint32_t tile = 0;
  cv::KeyPoint in_tile{};  ///< as the detector gave it, to be described
};

/// The pyramid that tiles need: fine scales in full resolution, coarse ones (from the octave on
/// where the tiles' margins end) in an eighth of it. Rows [first_row, end_row) of the panorama.
[[nodiscard]] std::vector<SiftLevel> BuildSiftLevels(const cv::Mat& panorama,
                                                     int first_row,
                                                     int end_row,
                                                     int tile_size_px);

/// Extrema whose centres lie in tiles' cores, sorted by (level, tile) and then as found.
/// One pyramid of one tile per thread is in memory. Lowe, IJCV 2004.
[[nodiscard]] absl::StatusOr<std::vector<SiftCandidate>> DetectSift(
    const std::vector<SiftLevel>& levels,
    const SiftThresholds& thresholds,
    const StageContext& context);

/// RootSIFT descriptors, candidates.size() x kDescriptorSize: the square root of the L1-normalised
/// SIFT histogram, times 512, 8 bits. Arandjelovic, Zisserman, CVPR 2012.
[[nodiscard]] absl::StatusOr<std::vector<uint8_t>> DescribeSift(
    const std::vector<SiftLevel>& levels,
    const std::vector<SiftCandidate>& candidates,
    const StageContext& context);

}  // namespace orbweave
