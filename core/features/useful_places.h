// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "core/scene/features.h"

namespace orbweave {

/// Where keypoints of a panorama are wanted.
class UsefulPlaces {
 public:
  /// Within `max_latitude_deg` of the horizon, and where `ignored` (empty, or as large as the
  /// panorama) is zero.
  UsefulPlaces(cv::Size panorama, double max_latitude_deg, cv::Mat ignored);

  /// Rows within the latitude limit, corner convention.
  [[nodiscard]] double first_y() const { return first_y_; }
  [[nodiscard]] double end_y() const { return end_y_; }

  /// Whether the keypoint's blob, two standard deviations wide, touches no ignored pixel: the
  /// border of a mask must not make features.
  [[nodiscard]] bool Contain(const Keypoint& keypoint) const;

 private:
  [[nodiscard]] bool IsIgnored(float x, float y) const;

  double first_y_ = 0.0;
  double end_y_ = 0.0;
  cv::Mat ignored_{};
};

}  // namespace orbweave
