// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

namespace orbweave::internal {

/// Rows of the grid of the first octave: greys (0 ... 255) of an 8-bit BGR panorama as OpenCV
/// weighs colours, or of its double by linear interpolation, where pixel j lies at j / 2 - 1/4.
class GreyRows {
 public:
  GreyRows(const cv::Mat& panorama, bool doubled);

  /// Writes row `y`; cheapest in order.
  void Write(int y, float* out);

 private:
  struct Kept {
    int row = std::numeric_limits<int>::min() / 2;  ///< none
    std::vector<float> greys{};  ///< with the neighbours across the seam at both ends
  };
  /// Row `row` of the panorama, which may lie one beyond a pole.
  const float* Greys(int row);

  const cv::Mat& panorama_;
  bool doubled_ = false;
  cv::Mat line_{};
  std::array<Kept, 2> kept_{};
  std::vector<float> mixed_{};
};

}  // namespace orbweave::internal
