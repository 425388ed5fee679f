// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "tests/core/pictures/encoded_images.h"

namespace orbweave {

/// A Gaussian blob on a panorama, position in the corner convention.
struct Blob {
  double x_px = 0.0;
  double y_px = 0.0;
  double sigma_px = 2.0;
  double contrast = 80.0;
};

/// Adds blobs to grey, columns wrapped. 8-bit BGR.
inline cv::Mat DrawBlobs(int width, const std::vector<Blob>& blobs) {
  cv::Mat grey(width / 2, width, CV_64FC1, cv::Scalar(110.0));
  for (const Blob& blob : blobs) {
    const int reach = static_cast<int>(std::ceil(5.0 * blob.sigma_px));
    for (int y = std::max(0, static_cast<int>(blob.y_px) - reach);
         y <= std::min(grey.rows - 1, static_cast<int>(blob.y_px) + reach);
         ++y) {
      for (int x = static_cast<int>(blob.x_px) - reach; x <= static_cast<int>(blob.x_px) + reach;
           ++x) {
        const double dx = x + 0.5 - blob.x_px;
        const double dy = y + 0.5 - blob.y_px;
        grey.at<double>(y, ((x % width) + width) % width) +=
            blob.contrast * std::exp(-0.5 * (dx * dx + dy * dy) / (blob.sigma_px * blob.sigma_px));
      }
    }
  }
  cv::Mat bytes;
  grey.convertTo(bytes, CV_8UC1);
  cv::Mat bgr;
  cv::merge(std::vector<cv::Mat>{bytes, bytes, bytes}, bgr);
  return bgr;
}

/// A panorama full of blobs of all sizes and contrasts.
inline cv::Mat TexturedPanorama(int width, uint64_t seed) {
  Random random(seed);
  std::vector<Blob> blobs;
  for (int i = 0; i < width * 3; ++i) {
    blobs.push_back({.x_px = random.Uniform(0.0, width),
                     .y_px = random.Uniform(0.0, width / 2.0),
                     .sigma_px = std::exp(random.Uniform(0.0, 2.0)),
                     .contrast = random.Uniform(-60.0, 60.0)});
  }
  return DrawBlobs(width, blobs);
}

/// The panorama turned about the vertical: column c moves to c + columns.
inline cv::Mat Rolled(const cv::Mat& panorama, int columns) {
  cv::Mat rolled(panorama.size(), panorama.type());
  for (int x = 0; x < panorama.cols; ++x) {
    panorama.col(x).copyTo(rolled.col((x + columns) % panorama.cols));
  }
  return rolled;
}

}  // namespace orbweave
