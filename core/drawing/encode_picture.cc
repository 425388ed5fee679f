// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/drawing/encode_picture.h"

#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace orbweave {
namespace {

absl::StatusOr<std::string> Encode(const cv::Mat& pixels,
                                   const std::string& ending,
                                   const std::vector<int>& parameters) {
  std::vector<uchar> bytes;
  try {
    if (cv::imencode(ending, pixels, bytes, parameters))
      return std::string(bytes.begin(), bytes.end());
  } catch (const cv::Exception& error) {
    return absl::InternalError("cannot encode the picture: " + error.err);
  }
  return absl::InternalError("cannot encode the picture");
}

}  // namespace

absl::StatusOr<std::string> EncodePng(const cv::Mat& pixels) { return Encode(pixels, ".png", {}); }

absl::StatusOr<std::string> EncodeJpeg(const cv::Mat& pixels, int quality) {
  return Encode(pixels, ".jpg", {cv::IMWRITE_JPEG_QUALITY, quality});
}

}  // namespace orbweave
