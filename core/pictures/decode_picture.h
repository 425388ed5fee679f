// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <string_view>

#include "absl/status/statusor.h"

namespace orbweave {

/// The one way from the bytes of a file to pixels: H x W x 3, 8-bit BGR, rows from the top as they
/// lie in the file. EXIF orientation is not applied, greyscale is tripled, 16 bits become 8, alpha
/// is dropped. JPEG by libjpeg, PNG by libpng, TIFF by libtiff, WebP by libwebp; BMP (uncompressed,
/// 8, 24 or 32 bits) and binary PPM and PGM here.
/// InvalidArgument, a sentence for people, when the file is of no such kind, truncated, damaged
/// within (a decoder's warnings are read: pictures that are cut are painted grey), or of other
/// sides than its header says. Callers look at ReadImageHeader first where size matters.
[[nodiscard]] absl::StatusOr<cv::Mat> DecodePicture(std::string_view encoded);

/// The same in grey: H x W, 8 bits, Y of BT.601.
[[nodiscard]] absl::StatusOr<cv::Mat> DecodeGreyPicture(std::string_view encoded);

}  // namespace orbweave
