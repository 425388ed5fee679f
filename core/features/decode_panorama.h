// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <string_view>

#include "absl/status/statusor.h"

namespace orbweave {

/// Pixels of an encoded 2:1 panorama (H x W x 3, 8-bit BGR), as they lie in the file: see
/// DecodePicture. InvalidArgument with a sentence for people when it cannot be used: wider than
/// `max_width_px` (refused before decoding), not 2:1 within one pixel, truncated, damaged within,
/// not decodable.
[[nodiscard]] absl::StatusOr<cv::Mat> DecodePanorama(std::string_view encoded, int max_width_px);

/// The mask of a panorama of `size`: H x W, 255 where pixels are to be ignored, else 0. A pixel of
/// the encoded mask counts as white above mid-grey. A mask of the same proportions in another
/// resolution is scaled; InvalidArgument when it has other proportions, is wider than
/// `max_width_px` (refused before decoding) or cannot be decoded.
[[nodiscard]] absl::StatusOr<cv::Mat> DecodeMask(std::string_view encoded,
                                                 cv::Size size,
                                                 int max_width_px,
                                                 bool ignores_white);

}  // namespace orbweave
