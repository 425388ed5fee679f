// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <string_view>

#include "absl/status/status.h"

namespace orbweave {

/// A decoder per kind of file (DecodePicture). Each fills `bgr`, which is allocated as the header
/// says (H x W x 3, 8 bits), and refuses data that contradict it. InvalidArgument without the
/// file's name: damaged, or of a form that is not read.
[[nodiscard]] absl::Status DecodeJpeg(std::string_view encoded, cv::Mat& bgr);
[[nodiscard]] absl::Status DecodePng(std::string_view encoded, cv::Mat& bgr);
[[nodiscard]] absl::Status DecodeTiff(std::string_view encoded, cv::Mat& bgr);
[[nodiscard]] absl::Status DecodeWebp(std::string_view encoded, cv::Mat& bgr);
[[nodiscard]] absl::Status DecodeBmp(std::string_view encoded, cv::Mat& bgr);
[[nodiscard]] absl::Status DecodePnm(std::string_view encoded, cv::Mat& bgr);

/// What every decoder says where the sides of the data are not those of the header.
[[nodiscard]] inline absl::Status DataContradictHeader() {
  return absl::InvalidArgumentError("the data contradict the header");
}

}  // namespace orbweave
