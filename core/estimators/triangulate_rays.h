// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/rigid3.h"

namespace orbweave {

/// The point that minimises the angular error to all rays: linear start, then Gauss-Newton.
/// `bearings` unit, in their camera frames. nullopt when there are fewer than two rays, when all
/// rays are (nearly) parallel, or when the point lies behind a ray (cheirality p . (R P + T) > 0).
[[nodiscard]] std::optional<Eigen::Vector3d> TriangulateRays(
    std::span<const Rigid3> cams_from_world, std::span<const Eigen::Vector3d> bearings);

/// Largest angle between two rays to a point, in radians; the camera centres are in the world.
[[nodiscard]] double MaxTriangulationAngle(const Eigen::Vector3d& point_in_world,
                                           std::span<const Eigen::Vector3d> centres);

struct RobustTriangulation {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  std::vector<uint8_t> is_inlier{};  ///< per ray
  uint32_t num_inliers = 0;
};

/// The point most rays agree on within max_error_rad, from exhaustive (few rays) or sampled pairs
/// with a triangulation angle of at least min_angle_rad; nullopt when fewer than two agree.
[[nodiscard]] std::optional<RobustTriangulation> TriangulateRobustly(
    std::span<const Rigid3> cams_from_world,
    std::span<const Eigen::Vector3d> bearings,
    double max_error_rad,
    double min_angle_rad);

}  // namespace orbweave
