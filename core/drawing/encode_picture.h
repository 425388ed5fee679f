// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "core/base/status.h"

namespace orbweave {

/// Pixels (BGR, or BGRA for PNG) as the bytes of a file.
[[nodiscard]] absl::StatusOr<std::string> EncodePng(const cv::Mat& pixels);
[[nodiscard]] absl::StatusOr<std::string> EncodeJpeg(const cv::Mat& pixels, int quality);

}  // namespace orbweave
