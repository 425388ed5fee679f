// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>

#include "core/scene/reconstruction.h"

namespace orbweave {

/// Where a track's point goes when its observers go from their poses in `from` to those in `to`,
/// `scale` times as large: each takes it along where it sees it, in the mean. A similarity of all
/// observers carries it exactly. nullopt: none of the observers is in both.
[[nodiscard]] inline std::optional<Eigen::Vector3d> CarryPoint(
    const Track& track,
    const std::map<ImageId, RegisteredImage>& from,
    const std::map<ImageId, RegisteredImage>& to,
    double scale) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const Observation& seen : track.observations) {
    const auto before = from.find(seen.ref.image);
    const auto after = to.find(seen.ref.image);
    if (before == from.end() || after == to.end()) continue;
    const Eigen::Vector3d in_cam = scale * (before->second.cam_from_world * track.point_in_world);
    sum += after->second.cam_from_world.Inverse() * in_cam;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

}  // namespace orbweave
