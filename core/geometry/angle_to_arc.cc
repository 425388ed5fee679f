// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/angle_to_arc.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/rotation.h"

namespace orbweave {

double AngleToArc(const Eigen::Vector3d& direction,
                  const Eigen::Vector3d& first,
                  const Eigen::Vector3d& last) {
  const Eigen::Vector3d normal = first.cross(last);
  const bool is_within = normal.cross(first).dot(direction) >= 0.0 &&
                         last.cross(normal).dot(direction) >= 0.0 && normal.norm() > 0.0;
  if (is_within)
    return std::abs(std::asin(std::clamp(normal.normalized().dot(direction), -1.0, 1.0)));
  return std::min(AngleBetween(first, direction), AngleBetween(last, direction));
}

}  // namespace orbweave
