// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pictures/decode_picture.h"

#include <opencv2/imgproc.hpp>

#include "core/base/status.h"
#include "core/pictures/decoders.h"
#include "core/pictures/image_header.h"

namespace orbweave {
namespace {

absl::Status DecodeByKind(std::string_view encoded, cv::Mat& bgr) {
  switch (IdentifyImage(encoded)) {
    case ImageKind::kJpeg:
      return DecodeJpeg(encoded, bgr);
    case ImageKind::kPng:
      return DecodePng(encoded, bgr);
    case ImageKind::kTiff:
      return DecodeTiff(encoded, bgr);
    case ImageKind::kBmp:
      return DecodeBmp(encoded, bgr);
    case ImageKind::kWebp:
      return DecodeWebp(encoded, bgr);
    case ImageKind::kPnm:
      return DecodePnm(encoded, bgr);
    case ImageKind::kUnknown:
      break;
  }
  return absl::InvalidArgumentError("the file is no picture");
}

}  // namespace

absl::StatusOr<cv::Mat> DecodePicture(std::string_view encoded) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageHeader header, ReadImageHeader(encoded));
  if (!header.complete) return absl::InvalidArgumentError("the file is truncated");
  cv::Mat bgr;
  try {
    bgr.create(header.height_px, header.width_px, CV_8UC3);
  } catch (const cv::Exception&) {
    return absl::InvalidArgumentError("the picture is too large for the memory");
  }
  ORBWEAVE_RETURN_IF_ERROR(DecodeByKind(encoded, bgr));
  return bgr;
}

absl::StatusOr<cv::Mat> DecodeGreyPicture(std::string_view encoded) {
  ORBWEAVE_ASSIGN_OR_RETURN(const cv::Mat bgr, DecodePicture(encoded));
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace orbweave
