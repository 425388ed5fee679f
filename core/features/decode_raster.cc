// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/decode_raster.h"

#include <opencv2/imgproc.hpp>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/features/decode_panorama.h"

namespace orbweave {
namespace {

std::vector<uint8_t> BytesOf(const cv::Mat& image) {
  std::vector<uint8_t> bytes;
  const auto row_bytes = static_cast<size_t>(image.cols) * image.elemSize();
  bytes.reserve(static_cast<size_t>(image.rows) * row_bytes);
  for (int row = 0; row < image.rows; ++row)
    bytes.insert(bytes.end(), image.ptr(row), image.ptr(row) + row_bytes);
  return bytes;
}

/// By area where it is reduced: a mask's pixel is ignored where any part of it is.
cv::Mat Resized(const cv::Mat& image, const cv::Size& size) {
  if (image.size() == size) return image;
  cv::Mat resized;
  cv::resize(
      image, resized, size, 0.0, 0.0, size.width < image.cols ? cv::INTER_AREA : cv::INTER_LINEAR);
  return resized;
}

}  // namespace

absl::StatusOr<DecodedRaster> DecodeRaster(std::string_view encoded,
                                           std::string_view encoded_mask,
                                           bool mask_ignores_white,
                                           const EquirectangularCamera& camera,
                                           int width_px) {
  ORBWEAVE_ASSIGN_OR_RETURN(const cv::Mat bgr, DecodePanorama(encoded, camera.width_px));
  if (bgr.cols != camera.width_px || bgr.rows != camera.height_px) {
    return absl::InvalidArgumentError(absl::StrCat("the picture is ",
                                                   bgr.cols,
                                                   "x",
                                                   bgr.rows,
                                                   ", its camera ",
                                                   camera.width_px,
                                                   "x",
                                                   camera.height_px));
  }
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  const cv::Size size(width_px, width_px / 2);
  DecodedRaster raster{.camera = {size.width, size.height}, .rgb = BytesOf(Resized(rgb, size))};
  if (encoded_mask.empty()) return raster;
  ORBWEAVE_ASSIGN_OR_RETURN(
      const cv::Mat mask,
      DecodeMask(encoded_mask, bgr.size(), 4 * camera.width_px, mask_ignores_white));
  raster.ignored = BytesOf(Resized(mask, size));
  return raster;
}

}  // namespace orbweave
