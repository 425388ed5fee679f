// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/random.h"
#include "core/scene/features.h"

/// Panoramas for tests that are seen by their features alone.
namespace orbweave::testing {

/// Of norm 512, and as uneven as those of real features.
inline std::vector<uint8_t> RandomDescriptor(Random& random) {
  std::vector<double> values(kDescriptorSize);
  double squares = 0.0;
  for (double& value : values) {
    value = std::pow(random.Uniform(), 3.0);
    squares += value * value;
  }
  std::vector<uint8_t> descriptor;
  for (const double value : values)
    descriptor.push_back(static_cast<uint8_t>(std::lround(value * 512.0 / std::sqrt(squares))));
  return descriptor;
}

/// The descriptor as another day shows it.
inline std::vector<uint8_t> ChangedDescriptor(Random& random,
                                              std::vector<uint8_t> descriptor,
                                              double noise) {
  for (uint8_t& value : descriptor) {
    const double changed = value + noise * random.Normal();
    value = static_cast<uint8_t>(std::clamp(changed, 0.0, 255.0));
  }
  return descriptor;
}

/// A feature where the camera sees `point_in_cam`.
inline void AppendFeature(Features& features,
                          const Eigen::Vector3d& point_in_cam,
                          const std::vector<uint8_t>& descriptor,
                          float scale_px = 1.0F) {
  const Eigen::Vector2d pixel = features.camera.PixelFromBearing(point_in_cam.normalized());
  features.keypoints.push_back({.x_px = static_cast<float>(pixel.x()),
                                .y_px = static_cast<float>(pixel.y()),
                                .scale_px = scale_px});
  features.sigma_rad.push_back(static_cast<float>(features.camera.AngleFromPixels(scale_px)));
  features.colors.emplace_back();
  features.descriptors.insert(features.descriptors.end(), descriptor.begin(), descriptor.end());
}

}  // namespace orbweave::testing
