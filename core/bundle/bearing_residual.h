// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace orbweave {

/// The residual of one observation and its derivatives; rows are the two axes of the tangent plane.
struct BearingResidual {
  Eigen::Vector2d r = Eigen::Vector2d::Zero();
  /// d r / d (w, C): the rotation R exp([w]x), perturbed on the right, and the centre in the world.
  Eigen::Matrix<double, 2, 6> d_pose = Eigen::Matrix<double, 2, 6>::Zero();
  Eigen::Matrix<double, 2, 3> d_point = Eigen::Matrix<double, 2, 3>::Zero();
};

/// Logarithm on the sphere, at the observed unit `bearing`, of the predicted ray u = R (X - C) /
/// |X - C|: r = theta / sin(theta) B^T u with B = TangentBasis(bearing); |r| = theta is the angle.
/// Near the antipode (theta > 174 degrees) |r| goes on to pi while the tangential derivative, which
/// would go to infinity, stays bounded; the gradient of |r|^2 / 2 does not need it and remains
/// exact. At the antipode itself r is pi along the first axis. X = C: everything is zero.
[[nodiscard]] BearingResidual EvaluateBearingResidual(const Eigen::Matrix3d& R,
                                                      const Eigen::Vector3d& centre_in_world,
                                                      const Eigen::Vector3d& point_in_world,
                                                      const Eigen::Vector3d& bearing);

}  // namespace orbweave
