// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace orbweave {

/// The file that OpenCV makes of the pixels: the oracle of our own encoders and decoders.
inline std::string Encoded(const cv::Mat& image,
                           const std::string& extension,
                           const std::vector<int>& parameters = {}) {
  std::vector<uint8_t> bytes;
  cv::imencode(extension, image, bytes, parameters);
  return {bytes.begin(), bytes.end()};
}

}  // namespace orbweave
