// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/useful_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/features/row_across_poles.h"

namespace orbweave {

UsefulPlaces::UsefulPlaces(cv::Size panorama, double max_latitude_deg, cv::Mat ignored)
    : ignored_(std::move(ignored)) {
  const double rows = max_latitude_deg / 180.0 * panorama.height;
  first_y_ = 0.5 * panorama.height - rows;
  end_y_ = 0.5 * panorama.height + rows;
}

bool UsefulPlaces::Contain(const Keypoint& keypoint) const {
  if (keypoint.y_px < static_cast<float>(first_y_) || keypoint.y_px > static_cast<float>(end_y_))
    return false;
  if (ignored_.empty()) return true;
  if (IsIgnored(keypoint.x_px, keypoint.y_px)) return false;
  const float radius = 2.0F * keypoint.scale_px;
  for (int k = 0; k < 8; ++k) {
    const float angle = std::numbers::pi_v<float> / 4.0F * static_cast<float>(k);
    if (IsIgnored(keypoint.x_px + radius * std::cos(angle),
                  keypoint.y_px + radius * std::sin(angle)))
      return false;
  }
  return true;
}

bool UsefulPlaces::IsIgnored(float x, float y) const {
  const int row = std::clamp(static_cast<int>(std::floor(y)), 0, ignored_.rows - 1);
  return ignored_.at<uint8_t>(row, Modulo(static_cast<int>(std::floor(x)), ignored_.cols)) != 0;
}

}  // namespace orbweave
