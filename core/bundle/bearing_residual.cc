// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/bearing_residual.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

constexpr double kMinSine = 0.1;  // of the tangential derivative near the antipode

}  // namespace

BearingResidual EvaluateBearingResidual(const Eigen::Matrix3d& R,
                                        const Eigen::Vector3d& centre_in_world,
                                        const Eigen::Vector3d& point_in_world,
                                        const Eigen::Vector3d& bearing) {
  BearingResidual result;
  const Eigen::Vector3d d = point_in_world - centre_in_world;
  const double range = d.norm();
  if (!(range > 0.0)) return result;
  const Eigen::Vector3d u = R * (d / range);
  const Eigen::Matrix<double, 3, 2> B = TangentBasis(bearing);
  const Eigen::Vector2d s = B.transpose() * u;
  const double sine = s.norm();
  const double cosine = bearing.dot(u);
  const double theta = std::atan2(sine, cosine);

  Eigen::Vector2d axis = sine > 0.0 ? Eigen::Vector2d(s / sine) : Eigen::Vector2d(1.0, 0.0);
  result.r = theta * axis;
  // dr = axis dtheta + tangential factor * (I - axis axis^T) B^T du; dtheta = cos d|s| - sin dc.
  double factor = 1.0;
  if (cosine < 0.0 || sine > 1e-8)
    factor = theta / (cosine < 0.0 ? std::max(sine, kMinSine) : sine);
  const Eigen::RowVector3d d_theta =
      cosine * axis.transpose() * B.transpose() - sine * bearing.transpose();
  const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - axis * axis.transpose();
  const Eigen::Matrix<double, 2, 3> d_unit = axis * d_theta + factor * across * B.transpose();
  const Eigen::Matrix3d unit_from_d = (Eigen::Matrix3d::Identity() - u * u.transpose()) * R / range;

  result.d_point = d_unit * unit_from_d;
  result.d_pose.leftCols<3>() = -result.d_point * SkewSymmetric(d);
  result.d_pose.rightCols<3>() = -result.d_point;
  return result;
}

}  // namespace orbweave
