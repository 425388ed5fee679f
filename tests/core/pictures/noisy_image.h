// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace orbweave {

/// Soft colours with noise upon them: no two rows or channels alike. Its width is no multiple of 4,
/// its sides are no multiples of a JPEG's block.
inline cv::Mat NoisyImage(int type = CV_8UC3, cv::Size size = {201, 99}) {
  cv::Mat image(size, type);
  cv::RNG random(7);
  random.fill(image, cv::RNG::UNIFORM, 0, image.depth() == CV_16U ? 65536 : 256);
  cv::GaussianBlur(image, image, {}, 1.5);
  return image;
}

}  // namespace orbweave
