// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift_tiles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/parallel_for.h"

namespace orbweave {
namespace {

constexpr int kLastFineOctave = 1;
constexpr int kCoarseFactor = 8;  // its octave -1 continues the octave kLastFineOctave
/// A descriptor reaches 10.6 standard deviations of its keypoint (a rotated 4 x 4 grid of cells 3
/// wide, and half a cell of interpolation), its blurred pixels 3 more: 13.6 x 6.7 px at the end of
/// octave 1.
constexpr int kMarginPx = 96;
constexpr int kSmallestCoarseImagePx = 16;

/// OpenCV doubles the image with pixel centres aligned, where pixel j of the doubled image lies at
/// j / 2 - 1/4, but reports j / 2 (OpenCV issue 23123).
constexpr float kDoublingBiasPx = 0.25F;
/// From pixel centres at whole numbers to corners at whole numbers.
constexpr float kCornerFromCentrePx = 0.5F;

struct TileRef {
  uint32_t level = 0;
  uint32_t tile = 0;
};

std::vector<TileRef> AllTiles(const std::vector<SiftLevel>& levels) {
  std::vector<TileRef> refs;
  for (uint32_t level = 0; level < levels.size(); ++level) {
    for (uint32_t tile = 0; tile < levels[level].tiles.size(); ++tile)
      refs.push_back({level, tile});
  }
  return refs;
}

/// OpenCV packs the octave into the lowest byte, as a signed number.
int OctaveOf(const cv::KeyPoint& keypoint) { return static_cast<int8_t>(keypoint.octave & 255); }

bool Contains(const cv::Rect& rect, const cv::Point2f& point) {
  return point.x >= static_cast<float>(rect.x) &&
         point.x < static_cast<float>(rect.x + rect.width) &&
         point.y >= static_cast<float>(rect.y) &&
         point.y < static_cast<float>(rect.y + rect.height);
}

Keypoint KeypointInPanorama(const cv::KeyPoint& found,
                            const cv::Point2f& in_level,
                            const SiftLevel& level) {
  const auto fx = static_cast<float>(level.panorama_from_level.x);
  const auto fy = static_cast<float>(level.panorama_from_level.y);
  const float width = fx * static_cast<float>(level.pixels.cols);
  const float x = in_level.x * fx;
  return {.x_px = x < width ? x : x - width,  // rounding may reach the seam
          .y_px = in_level.y * fy,
          .scale_px = found.size * 0.5F * std::sqrt(fx * fy),  // OpenCV's size is a diameter
          .orientation_rad = found.angle * std::numbers::pi_v<float> / 180.0F};
}

std::vector<SiftCandidate> DetectInTile(const SiftLevel& level,
                                        TileRef ref,
                                        const SiftThresholds& thresholds) {
  const Tile& tile = level.tiles[ref.tile];
  std::vector<cv::KeyPoint> found;
  cv::SIFT::create(0, 3, thresholds.contrast, thresholds.edge, 1.6)
      ->detect(CutTile(level.pixels, tile.padded), found);
  std::vector<SiftCandidate> candidates;
  for (const cv::KeyPoint& keypoint : found) {
    const float shift = kCornerFromCentrePx - kDoublingBiasPx;
    const cv::Point2f in_level =
        keypoint.pt + cv::Point2f(tile.padded.tl()) + cv::Point2f(shift, shift);
    if (OctaveOf(keypoint) > level.last_octave || !Contains(tile.core, in_level)) continue;
    candidates.push_back({.keypoint = KeypointInPanorama(keypoint, in_level, level),
                          .response = keypoint.response,
                          .level = ref.level,
                          .tile = ref.tile,
                          .in_tile = keypoint});
  }
  return candidates;
}

void WriteRootSift(const float* sift, uint8_t* root_sift) {
  float sum = 0.0F;
  for (int k = 0; k < kDescriptorSize; ++k) sum += sift[k];
  const float scale = sum > 0.0F ? 512.0F * 512.0F / sum : 0.0F;
  for (int k = 0; k < kDescriptorSize; ++k) {
    root_sift[k] = static_cast<uint8_t>(std::min(255.0F, std::sqrt(sift[k] * scale) + 0.5F));
  }
}

/// Describes the candidates `indices`, all of one tile, into their rows of `descriptors`.
void DescribeInTile(const SiftLevel& level,
                    TileRef ref,
                    const std::vector<SiftCandidate>& candidates,
                    const std::vector<size_t>& indices,
                    std::vector<uint8_t>& descriptors) {
  std::vector<cv::KeyPoint> keypoints;
  for (const size_t i : indices) keypoints.push_back(candidates[i].in_tile);
  cv::Mat sift;
  cv::SIFT::create()->compute(CutTile(level.pixels, level.tiles[ref.tile].padded), keypoints, sift);
  ORBWEAVE_CHECK(keypoints.size() == indices.size());
  for (size_t row = 0; row < indices.size(); ++row) {
    WriteRootSift(sift.ptr<float>(static_cast<int>(row)),
                  &descriptors[indices[row] * kDescriptorSize]);
  }
}

SiftLevel CoarseLevel(const cv::Mat& panorama, int first_row, int end_row, int tile_size_px) {
  SiftLevel level{.last_octave = 127};
  const cv::Size size((panorama.cols + kCoarseFactor / 2) / kCoarseFactor,
                      (panorama.rows + kCoarseFactor / 2) / kCoarseFactor);
  if (size.height < kSmallestCoarseImagePx) return level;
  cv::resize(panorama, level.pixels, size, 0, 0, cv::INTER_AREA);
  level.panorama_from_level = {static_cast<double>(panorama.cols) / size.width,
                               static_cast<double>(panorama.rows) / size.height};
  const int end = static_cast<int>(std::ceil(end_row / level.panorama_from_level.y));
  level.tiles = PlanTiles(size,
                          static_cast<int>(first_row / level.panorama_from_level.y),
                          end,
                          tile_size_px,
                          kMarginPx);
  return level;
}

}  // namespace

std::vector<SiftLevel> BuildSiftLevels(const cv::Mat& panorama,
                                       int first_row,
                                       int end_row,
                                       int tile_size_px) {
  SiftLevel fine{.pixels = panorama, .last_octave = kLastFineOctave};
  fine.tiles = PlanTiles(panorama.size(), first_row, end_row, tile_size_px, kMarginPx);
  return {fine, CoarseLevel(panorama, first_row, end_row, tile_size_px)};
}

absl::StatusOr<std::vector<SiftCandidate>> DetectSift(const std::vector<SiftLevel>& levels,
                                                      const SiftThresholds& thresholds,
                                                      const StageContext& context) {
  const std::vector<TileRef> refs = AllTiles(levels);
  std::vector<std::vector<SiftCandidate>> of_tile(refs.size());
  ParallelFor(refs.size(), context.num_threads, [&](size_t i) {
    if (context.stop.stop_requested()) return;
    of_tile[i] = DetectInTile(levels[refs[i].level], refs[i], thresholds);
  });
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  std::vector<SiftCandidate> candidates;
  for (const std::vector<SiftCandidate>& some : of_tile)
    candidates.insert(candidates.end(), some.begin(), some.end());
  return candidates;
}

absl::StatusOr<std::vector<uint8_t>> DescribeSift(const std::vector<SiftLevel>& levels,
                                                  const std::vector<SiftCandidate>& candidates,
                                                  const StageContext& context) {
  const std::vector<TileRef> refs = AllTiles(levels);
  std::vector<std::vector<size_t>> of_tile(refs.size());
  const auto num_fine_tiles = static_cast<uint32_t>(levels.front().tiles.size());
  for (size_t i = 0; i < candidates.size(); ++i) {
    of_tile[candidates[i].level * num_fine_tiles + candidates[i].tile].push_back(i);
  }
  std::vector<uint8_t> descriptors(candidates.size() * kDescriptorSize);
  ParallelFor(refs.size(), context.num_threads, [&](size_t i) {
    if (of_tile[i].empty() || context.stop.stop_requested()) return;
    DescribeInTile(levels[refs[i].level], refs[i], candidates, of_tile[i], descriptors);
  });
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  return descriptors;
}

}  // namespace orbweave
