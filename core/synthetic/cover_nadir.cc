// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/cover_nadir.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace orbweave {
namespace {

/// A mean over 1/12 of the width and 1/24 of the height: nothing but colours is left.
void BlurRows(cv::Mat rows) {
  const int across = std::max(1, rows.cols / 24);
  cv::Mat wide;
  cv::copyMakeBorder(rows, wide, 0, 0, across, across, cv::BORDER_WRAP);
  const cv::Size size(2 * across + 1, std::max(1, rows.cols / 48) | 1);
  cv::blur(wide, wide, size, {-1, -1}, cv::BORDER_REPLICATE);
  wide(cv::Rect(across, 0, rows.cols, rows.rows)).copyTo(rows);
}

}  // namespace

void CoverNadir(RenderedPanorama& panorama, NadirKind nadir) {
  if (nadir != NadirKind::kBlack && nadir != NadirKind::kBlurred) return;
  const int width = panorama.camera.width_px;
  const int height = panorama.camera.height_px;
  const int first = 3 * height / 4;
  cv::Mat image(height, width, CV_8UC3, panorama.pixels.data());
  cv::Mat rows = image.rowRange(first, height);
  if (nadir == NadirKind::kBlack) {
    rows.setTo(cv::Scalar::all(0));
  } else {
    BlurRows(rows);
  }
  std::fill(panorama.ignored.begin() + static_cast<std::ptrdiff_t>(first) * width,
            panorama.ignored.end(),
            uint8_t{255});
}

}  // namespace orbweave
