// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/extract_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <string>

#include "core/features/decode_panorama.h"
#include "core/features/extract_facades.h"
#include "core/features/extract_streaming_sift.h"
#include "core/features/extract_tiled_sift.h"
#include "core/features/row_across_poles.h"

namespace orbweave {
namespace {

/// Pixel at a position in the corner convention, columns wrapped and rows clamped.
const cv::Vec3b& PixelAt(const cv::Mat& panorama, int column, int row) {
  return panorama.at<cv::Vec3b>(std::clamp(row, 0, panorama.rows - 1),
                                Modulo(column, panorama.cols));
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

Features WithoutFeatures(std::string_view name, const absl::Status& problem) {
  Features features;
  features.problem = std::string(problem.message());
  if (!name.empty()) features.problem = std::string(name) + ": " + features.problem;
  return features;
}

Features Assemble(const cv::Mat& panorama, DescribedKeypoints described) {
  Features features{.camera = {.width_px = panorama.cols, .height_px = panorama.rows},
                    .keypoints = std::move(described.keypoints),
                    .descriptors = std::move(described.descriptors)};
  const double pixel_rad = features.camera.AngleFromPixels(1.0);
  for (size_t i = 0; i < features.size(); ++i) {
    features.sigma_rad.push_back(static_cast<float>(pixel_rad * described.sigma_px[i]));
    features.colors.push_back(SampleColor(panorama, features.keypoints[i]));
  }
  return features;
}

absl::StatusOr<Features> ExtractFromPixels(const cv::Mat& panorama,
                                           const cv::Mat& ignored,
                                           bool wants_facades,
                                           const ExtractOptions& options,
                                           const StageContext& context) {
  const UsefulPlaces places(panorama.size(), options.max_latitude_deg, ignored);
  const auto extract =
      options.detector == SiftDetector::kOpencv ? ExtractTiledSift : ExtractStreamingSift;
  ORBWEAVE_ASSIGN_OR_RETURN(DescribedKeypoints described,
                            extract(panorama, places, options, context));
  Features features = Assemble(panorama, std::move(described));
  if (wants_facades)
    ORBWEAVE_RETURN_IF_ERROR(AppendFacadeFeatures(panorama, ignored, options, context, features));
  return features;
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
    return ExtractFromPixels(*panorama, ignored, input.wants_facades, options, context);
  } catch (const cv::Exception& error) {
    return WithoutFeatures(input.name,
                           absl::InternalError("features cannot be found: " + error.err));
  }
}

}  // namespace orbweave
