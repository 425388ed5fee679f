// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "core/base/status.h"

namespace orbweave {

/// Pixels of 8 bits (grey or BGR, or BGRA for PNG) as the bytes of a file. JPEG as libjpeg does by
/// default: JFIF, colours at half the resolution, Huffman codes of the standard.
[[nodiscard]] absl::StatusOr<std::string> EncodePng(const cv::Mat& pixels);
[[nodiscard]] absl::StatusOr<std::string> EncodeJpeg(const cv::Mat& pixels, int quality);

}  // namespace orbweave
