// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/drawing/draw_top_view.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/pictures/encode_picture.h"

namespace orbweave {

absl::StatusOr<std::string> DrawTopView(const TopPicture& picture) {
  cv::Mat pixels(picture.height_px, picture.width_px, CV_8UC4);
  std::ranges::copy(picture.rgba, pixels.ptr());
  cv::cvtColor(pixels, pixels, cv::COLOR_RGBA2BGRA);
  return EncodePng(pixels);
}

}  // namespace orbweave
