// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/extract_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <string>

#include "core/features/decode_panorama.h"
#include "core/features/select_spread.h"
#include "core/features/sift_tiles.h"

namespace orbweave {
namespace {

/// Up to the end of octave 0 a keypoint is good for a pixel. Beyond it the distance of verified
/// matches from their epipolar plane grows with the square root of the scale, measured between 1
/// and 32 px on indoor, aerial and street panoramas.
constexpr float kPixelExactScalePx = 3.2F;

float SigmaPixels(float scale_px) {
  return std::sqrt(std::max(1.0F, scale_px / kPixelExactScalePx));
}

int Wrap(int column, int width) { return ((column % width) + width) % width; }

/// Pixel at a position in the corner convention, columns wrapped and rows clamped.
const cv::Vec3b& PixelAt(const cv::Mat& panorama, int column, int row) {
  return panorama.at<cv::Vec3b>(std::clamp(row, 0, panorama.rows - 1), Wrap(column, panorama.cols));
}

Rgb SampleColor(const cv::Mat& panorama, const Keypoint& keypoint) {
  const float x = keypoint.x_px - 0.5F;
  const float y = keypoint.y_px - 0.5F;
  const auto column = static_cast<int>(std::floor(x));
  const auto row = static_cast<int>(std::floor(y));
  const float u = x - std::floor(x);
  const float v = y - std::floor(y);
  std::array<uint8_t, 3> bgr{};
  for (int k = 0; k < 3; ++k) {
    const float above =
        (1 - u) * PixelAt(panorama, column, row)[k] + u * PixelAt(panorama, column + 1, row)[k];
    const float below = (1 - u) * PixelAt(panorama, column, row + 1)[k] +
                        u * PixelAt(panorama, column + 1, row + 1)[k];
    bgr[static_cast<size_t>(k)] = static_cast<uint8_t>((1 - v) * above + v * below + 0.5F);
  }
  return {.r = bgr[2], .g = bgr[1], .b = bgr[0]};
}

/// Whether a keypoint's blob, two standard deviations wide, touches an ignored pixel: the border of
/// a mask must not make features.
bool IsMasked(const cv::Mat& ignored, const Keypoint& keypoint) {
  if (ignored.empty()) return false;
  const auto is_ignored = [&](float x, float y) {
    const int row = std::clamp(static_cast<int>(std::floor(y)), 0, ignored.rows - 1);
    return ignored.at<uint8_t>(row, Wrap(static_cast<int>(std::floor(x)), ignored.cols)) != 0;
  };
  if (is_ignored(keypoint.x_px, keypoint.y_px)) return true;
  const float radius = 2.0F * keypoint.scale_px;
  for (int k = 0; k < 8; ++k) {
    const float angle = std::numbers::pi_v<float> / 4.0F * static_cast<float>(k);
    if (is_ignored(keypoint.x_px + radius * std::cos(angle),
                   keypoint.y_px + radius * std::sin(angle)))
      return true;
  }
  return false;
}

Features WithoutFeatures(std::string_view name, const absl::Status& problem) {
  Features features;
  features.problem = std::string(problem.message());
  if (!name.empty()) features.problem = std::string(name) + ": " + features.problem;
  return features;
}

/// Rows within the latitude limit, corner convention.
struct RowLimits {
  double first = 0.0;
  double end = 0.0;
};

RowLimits RowsOfLatitudes(const EquirectangularCamera& camera, double max_latitude_deg) {
  const double rows = max_latitude_deg / 180.0 * camera.height_px;
  return {0.5 * camera.height_px - rows, 0.5 * camera.height_px + rows};
}

std::vector<SiftCandidate> Useful(std::vector<SiftCandidate> candidates,
                                  const RowLimits& rows,
                                  const cv::Mat& ignored) {
  std::erase_if(candidates, [&](const SiftCandidate& candidate) {
    const float y = candidate.keypoint.y_px;
    return y < static_cast<float>(rows.first) || y > static_cast<float>(rows.end) ||
           IsMasked(ignored, candidate.keypoint);
  });
  return candidates;
}

Features Assemble(const EquirectangularCamera& camera,
                  const cv::Mat& panorama,
                  const std::vector<SiftCandidate>& candidates,
                  std::vector<uint8_t> descriptors) {
  Features features{.camera = camera, .descriptors = std::move(descriptors)};
  const double pixel_rad = camera.AngleFromPixels(1.0);
  for (const SiftCandidate& candidate : candidates) {
    features.keypoints.push_back(candidate.keypoint);
    features.sigma_rad.push_back(
        static_cast<float>(pixel_rad * SigmaPixels(candidate.keypoint.scale_px)));
    features.colors.push_back(SampleColor(panorama, candidate.keypoint));
  }
  return features;
}

absl::StatusOr<Features> ExtractFromPixels(const cv::Mat& panorama,
                                           const cv::Mat& ignored,
                                           const ExtractOptions& options,
                                           const StageContext& context) {
  const EquirectangularCamera camera{.width_px = panorama.cols, .height_px = panorama.rows};
  const RowLimits rows = RowsOfLatitudes(camera, options.max_latitude_deg);
  const std::vector<SiftLevel> levels = BuildSiftLevels(panorama,
                                                        static_cast<int>(std::floor(rows.first)),
                                                        static_cast<int>(std::ceil(rows.end)),
                                                        options.tile_size_px);
  ORBWEAVE_ASSIGN_OR_RETURN(
      std::vector<SiftCandidate> candidates,
      DetectSift(levels,
                 {.contrast = options.contrast_threshold, .edge = options.edge_threshold},
                 context));
  candidates = SelectSpread(camera,
                            Useful(std::move(candidates), rows, ignored),
                            static_cast<size_t>(options.max_features));
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<uint8_t> descriptors,
                            DescribeSift(levels, candidates, context));
  return Assemble(camera, panorama, candidates, std::move(descriptors));
}

}  // namespace

absl::StatusOr<Features> ExtractFeatures(const ExtractInput& input,
                                         const ExtractOptions& options,
                                         const StageContext& context) {
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  const absl::StatusOr<cv::Mat> panorama =
      DecodePanorama(input.encoded_image, options.max_image_width_px);
  if (!panorama.ok()) return WithoutFeatures(input.name, panorama.status());
  cv::Mat ignored;
  if (!input.encoded_mask.empty()) {
    const absl::StatusOr<cv::Mat> mask = DecodeMask(
        input.encoded_mask, panorama->size(), options.max_image_width_px, input.mask_ignores_white);
    if (!mask.ok()) return WithoutFeatures(input.name, mask.status());
    ignored = *mask;
  }
  try {
    return ExtractFromPixels(*panorama, ignored, options, context);
  } catch (const cv::Exception& error) {
    return WithoutFeatures(input.name,
                           absl::InternalError("features cannot be found: " + error.err));
  }
}

}  // namespace orbweave
