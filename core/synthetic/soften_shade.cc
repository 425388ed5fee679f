// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/soften_shade.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace orbweave {

void SoftenShade(RenderedPanorama& panorama, double sigma_px) {
  if (sigma_px == 0.0) return;
  const int width = panorama.camera.width_px;
  const int height = panorama.camera.height_px;
  const int margin = std::min(width, static_cast<int>(std::ceil(3.0 * sigma_px)));
  cv::Mat image(height, width, CV_8UC3, panorama.pixels.data());
  cv::Mat wide;
  cv::copyMakeBorder(image, wide, 0, 0, margin, margin, cv::BORDER_WRAP);
  cv::GaussianBlur(wide, wide, {2 * margin + 1, 2 * margin + 1}, sigma_px, 0, cv::BORDER_REPLICATE);
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const auto& soft = wide.at<cv::Vec3b>(j, i + margin);
      const double level = (soft[0] + soft[1] + soft[2]) / 3.0;
      const double share = std::clamp((120.0 - level) / 80.0, 0.0, 1.0);
      auto& sharp = image.at<cv::Vec3b>(j, i);
      for (int c = 0; c < 3; ++c) {
        sharp[c] = static_cast<uint8_t>(std::lround(std::lerp(sharp[c], soft[c], share)));
      }
    }
  }
}

}  // namespace orbweave
