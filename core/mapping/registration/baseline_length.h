// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

namespace orbweave {

/// Length s > 0 of a baseline with the unit `direction` at whose end the line along the unit `ray`
/// comes nearest to a point P, given from the baseline's start: (s d - P) x v = 0 in the least
/// squares sense. Zero: behind the start, or the two are parallel to within 0.02 rad.
[[nodiscard]] inline double BaselineLength(const Eigen::Vector3d& point_from_start,
                                           const Eigen::Vector3d& direction,
                                           const Eigen::Vector3d& ray) {
  constexpr double kMinSine = 0.02;
  const Eigen::Vector3d across = direction.cross(ray);
  if (across.norm() < kMinSine) return 0.0;
  return std::max(0.0, point_from_start.cross(ray).dot(across) / across.squaredNorm());
}

}  // namespace orbweave
