// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/turned_two_point.h"

#include "core/geometry/epipolar.h"

namespace orbweave {

using Eigen::Vector3d;

std::optional<Rigid3> SolveTurnedTwoPoint(const Eigen::Quaterniond& rotation,
                                          std::span<const Vector3d, 2> bearings_a,
                                          std::span<const Vector3d, 2> bearings_b) {
  const Vector3d first = (rotation * bearings_a[0]).cross(bearings_b[0]);
  const Vector3d second = (rotation * bearings_a[1]).cross(bearings_b[1]);
  const Vector3d direction = first.cross(second);
  if (!(direction.squaredNorm() > 0.0)) return std::nullopt;
  const Rigid3 pose{rotation, direction.normalized()};
  if (IsInFrontOfBoth(pose, bearings_a[0], bearings_b[0])) return pose;
  return Rigid3{rotation, -pose.translation};
}

}  // namespace orbweave
