// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/equirectangular_camera.h"
#include "core/scene/ids.h"

namespace orbweave {

struct Rgb {
  uint8_t r = 0;
  uint8_t g = 0;
  uint8_t b = 0;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// Where a feature lies in its panorama. x in [0, W), y in [0, H], corner convention of
/// EquirectangularCamera (the middle of the first pixel is at 0.5, 0.5).
struct Keypoint {
  float x_px = 0.0F;
  float y_px = 0.0F;
  float scale_px = 1.0F;
  float orientation_rad = 0.0F;
};

constexpr int kDescriptorSize = 128;

/// The features of one panorama. After extraction an observation is a bearing with an angular
/// sigma; the pixel is kept beside it for colour and export.
struct Features {
  EquirectangularCamera camera{};
  std::vector<Keypoint> keypoints{};
  std::vector<float> sigma_rad{};  ///< size(): standard deviation of the bearing, radians
  std::vector<uint8_t>
      descriptors{};  ///< size() x kDescriptorSize, row-major RootSIFT x 512; empty from a database
  std::vector<Rgb> colors{};  ///< size()
  /// Of each, in which facade view it was found (FacadeView), counted from 1; those of the panorama
  /// itself, 0, come first. Empty where all are.
  std::vector<uint8_t> view{};
  /// Why the image has no features ("cannot decode: ..."), empty when all is well.
  std::string problem{};

  [[nodiscard]] size_t size() const { return keypoints.size(); }
  /// Those of the panorama itself.
  [[nodiscard]] size_t NumPlain() const {
    return view.empty() ? size()
                        : static_cast<size_t>(std::ranges::upper_bound(view, 0) - view.begin());
  }
  [[nodiscard]] Eigen::Vector3d Bearing(FeatureIndex i) const {
    return camera.BearingFromPixel({keypoints[i].x_px, keypoints[i].y_px});
  }
  [[nodiscard]] const uint8_t* Descriptor(FeatureIndex i) const {
    return descriptors.data() + static_cast<size_t>(i) * kDescriptorSize;
  }
};

/// All bearings of a panorama, once, for those who ask for many.
[[nodiscard]] std::vector<Eigen::Vector3d> BearingsOf(const Features& features);

}  // namespace orbweave
