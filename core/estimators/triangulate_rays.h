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

/// How many times further the second nearest of the centres is from the point than the nearest:
/// infinite for a point in a centre, 1 for fewer than two centres.
[[nodiscard]] double RangeGap(const Eigen::Vector3d& point_in_world,
                              std::span<const Eigen::Vector3d> centres);

/// Beyond it one camera would see a feature in more than four octaves of the size that all others
/// see it in, which no descriptor matches over. Such a point is a wrong match whose rays happen to
/// meet in a camera: any bearing of that one agrees with it, and it nails the camera to the others'
/// rays with a precision of the bearing's times its own tiny distance.
inline constexpr double kMaxRangeGap = 16.0;

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
