// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/decode_panorama.h"

#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/base/status.h"
#include "core/pictures/decode_picture.h"
#include "core/pictures/image_header.h"

namespace orbweave {
namespace {

std::string SizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

absl::Status CheckWidth(const ImageHeader& header, int max_width_px) {
  if (header.width_px <= max_width_px) return absl::OkStatus();
  return absl::InvalidArgumentError("too large: " + SizeText(header.width_px, header.height_px) +
                                    ", at most " + std::to_string(max_width_px) + " wide");
}

absl::Status CheckPanoramaSize(const ImageHeader& header, int max_width_px) {
  if (std::abs(header.width_px - 2L * header.height_px) > 1) {
    return absl::InvalidArgumentError("not 2:1: " + SizeText(header.width_px, header.height_px));
  }
  return CheckWidth(header, max_width_px);
}

/// Whether scaling the mask to the image's width gives the image's height within a pixel.
bool HaveSameProportions(const ImageHeader& mask, cv::Size image) {
  const double height = static_cast<double>(mask.height_px) * image.width / mask.width_px;
  return std::abs(height - image.height) <= 1.0;
}

}  // namespace

absl::StatusOr<cv::Mat> DecodePanorama(std::string_view encoded, int max_width_px) {
  const absl::StatusOr<ImageHeader> header = ReadImageHeader(encoded);
  if (!header.ok()) return Annotate(header.status(), "cannot decode");
  ORBWEAVE_RETURN_IF_ERROR(CheckPanoramaSize(*header, max_width_px));
  absl::StatusOr<cv::Mat> image = DecodePicture(encoded);
  if (!image.ok()) return Annotate(image.status(), "cannot decode");
  return image;
}

absl::StatusOr<cv::Mat> DecodeMask(std::string_view encoded,
                                   cv::Size size,
                                   int max_width_px,
                                   bool ignores_white) {
  const absl::StatusOr<ImageHeader> header = ReadImageHeader(encoded);
  if (!header.ok()) return Annotate(header.status(), "cannot decode the mask");
  if (!HaveSameProportions(*header, size)) {
    return absl::InvalidArgumentError(
        "the mask is " + SizeText(header->width_px, header->height_px) +
        ", which does not cover an image of " + SizeText(size.width, size.height));
  }
  if (const absl::Status size_status = CheckWidth(*header, max_width_px); !size_status.ok())
    return Annotate(size_status, "the mask is");
  absl::StatusOr<cv::Mat> mask = DecodeGreyPicture(encoded);
  if (!mask.ok()) return Annotate(mask.status(), "cannot decode the mask");
  if (mask->size() != size) cv::resize(*mask, *mask, size, 0, 0, cv::INTER_NEAREST);
  return ignores_white ? cv::Mat(*mask > 127) : cv::Mat(*mask <= 127);
}

}  // namespace orbweave
