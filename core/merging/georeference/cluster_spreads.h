// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <span>

#include "core/scene/reconstruction.h"

namespace orbweave {

/// Where points are, and how far apart.
struct Spread {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double rms = 0.0;  ///< distance from the centre
};

/// Of one point at least.
[[nodiscard]] Spread SpreadOf(std::span<const Eigen::Vector3d> points);

/// The spread of each cluster's camera centres, in the frame and unit of the world; loose images do
/// not count, and clusters that have no others are left out.
[[nodiscard]] std::map<uint32_t, Spread> ClusterSpreads(
    const Reconstruction& scene, const std::map<ImageId, uint32_t>& cluster_of_image);

}  // namespace orbweave
