// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/refine_absolute_pose.h"

#include <algorithm>

#include "core/geometry/rotation.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kAntipode = 1e-9;  // keeps the residual finite where it has no direction

}  // namespace

Rigid3 MovePose(const Rigid3& cam_from_world, const Eigen::Matrix<double, 6, 1>& delta) {
  const Eigen::Quaterniond turn = RotationFromVector(delta.head<3>());
  return {(turn * cam_from_world.rotation).normalized(),
          turn * (cam_from_world.translation - delta.tail<3>())};
}

Linearisation<6> LineariseTangentResiduals(const Rigid3& cam_from_world,
                                           std::span<const Vector3d> bearings,
                                           std::span<const Vector3d> points_in_world,
                                           double loss_scale_rad) {
  const CauchyLoss loss(loss_scale_rad);
  const Matrix3d R = cam_from_world.rotation.toRotationMatrix();
  Linearisation<6> sum;
  for (size_t i = 0; i < bearings.size(); ++i) {
    const Vector3d& b = bearings[i];
    const Vector3d v = R * points_in_world[i] + cam_from_world.translation;
    const double rho = v.norm();
    if (!(rho > 0.0)) continue;  // the point is the centre: no direction
    const Vector3d u = v / rho;
    const double one_plus_cos = std::max(kAntipode, 1.0 + b.dot(u));
    const Eigen::Matrix<double, 3, 2> B = TangentBasis(b);
    const Eigen::Vector2d r = 2.0 / one_plus_cos * (B.transpose() * u);
    const double weight = loss.Weight(r.squaredNorm());
    for (int k = 0; k < 2; ++k) {
      // dr = w.du with du = theta x u - (I - u u^T) gamma / rho.
      const Vector3d w = (2.0 * B.col(k) - r[k] * b) / one_plus_cos;
      Eigen::Matrix<double, 6, 1> J;
      J << u.cross(w), (u * u.dot(w) - w) / rho;
      sum.Add(r[k], J, weight);
    }
    sum.cost += loss.Cost(r.squaredNorm());
  }
  return sum;
}

Rigid3 MinimiseTangentResiduals(const Rigid3& initial,
                                std::span<const Vector3d> bearings,
                                std::span<const Vector3d> points_in_world,
                                double loss_scale_rad,
                                int max_steps) {
  const auto linearise = [&](const Rigid3& pose) {
    return LineariseTangentResiduals(pose, bearings, points_in_world, loss_scale_rad);
  };
  return MinimiseLevenbergMarquardt<6>(initial, linearise, MovePose, {.max_steps = max_steps});
}

}  // namespace orbweave
