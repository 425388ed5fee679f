// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/scene/reconstruction.h"

namespace orbweave {

/// Two panoramas that see one point.
[[nodiscard]] inline Reconstruction TwoViewsOfAPoint() {
  Reconstruction scene;
  scene.images[ImageId(0)] = {};
  scene.images[ImageId(2)] = {
      .cam_from_world = {Eigen::Quaterniond::Identity(), Eigen::Vector3d(-1, 0, 0)}, .loose = true};
  scene.images[ImageId(2)].uncertainty = {Eigen::Matrix3d::Identity(), 0.01};
  Track track{.point_in_world = {0, 0, 2}, .color = {1, 2, 250}};
  track.observations.push_back({{ImageId(0), 3}, Eigen::Vector3d(0, 0, 1), 1e-3});
  track.observations.push_back({{ImageId(2), 4}, Eigen::Vector3d(-0.6, 0, 0.8), 1e-3});
  scene.tracks.push_back(track);
  return scene;
}

}  // namespace orbweave
