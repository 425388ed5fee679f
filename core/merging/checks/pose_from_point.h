// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace orbweave {

/// A = [[d]x; -I], d from the centre to the point: a bearing's Jacobian by the pose (w, C), turned,
/// is A times that by the point, so that Hessians are A M A^T and gradients A g.
inline Eigen::Matrix<double, 6, 3> PoseFromPoint(const Eigen::Vector3d& d) {
  Eigen::Matrix<double, 6, 3> A;
  A << 0.0, -d.z(), d.y(), d.z(), 0.0, -d.x(), -d.y(), d.x(), 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0,
      0.0, 0.0, -1.0;
  return A;
}

}  // namespace orbweave
