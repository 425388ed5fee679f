// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/refine_two_view.h"

#include <cmath>

#include "core/geometry/rotation.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kEpipole = 1e-12;  // squared sine to the baseline; closer bearings have no plane

}  // namespace

Rigid3 MoveRelativePose(const Rigid3& b_from_a, const Eigen::Matrix<double, 5, 1>& delta) {
  const Vector3d& T = b_from_a.translation;
  return {(RotationFromVector(delta.head<3>()) * b_from_a.rotation).normalized(),
          (T + TangentBasis(T) * delta.tail<2>()).normalized()};
}

Linearisation<5> LineariseEpipolarResiduals(const Rigid3& b_from_a,
                                            std::span<const Vector3d> bearings_a,
                                            std::span<const Vector3d> bearings_b,
                                            double loss_scale_rad) {
  const CauchyLoss loss(loss_scale_rad);
  const Eigen::Matrix3d R = b_from_a.rotation.toRotationMatrix();
  const Vector3d& T = b_from_a.translation;
  const Eigen::Matrix<double, 3, 2> B = TangentBasis(T);
  Linearisation<5> sum;
  for (size_t i = 0; i < bearings_a.size(); ++i) {
    const Vector3d q = R * bearings_a[i];
    const Vector3d& p = bearings_b[i];
    const double along_a = T.dot(q);
    const double along_b = T.dot(p);
    const double s2 = 1.0 - 0.5 * (along_a * along_a + along_b * along_b);
    if (!(s2 > kEpipole)) continue;
    const double s = std::sqrt(s2);
    // r = f / s, f = T.(q x p); dq = theta x q, dT = B tau; dr = df / s - f / (2 s^3) d(s^2).
    const Vector3d normal = q.cross(p);
    const double r = T.dot(normal) / s;
    const double k = r / (2.0 * s2);
    const Vector3d df_dtheta = q.cross(p.cross(T));
    const Vector3d ds2_dtheta = -along_a * q.cross(T);
    const Vector3d ds2_dT = -along_a * q - along_b * p;
    Eigen::Matrix<double, 5, 1> J;
    J << df_dtheta / s - k * ds2_dtheta, B.transpose() * (normal / s - k * ds2_dT);
    sum.Add(r, J, loss.Weight(r * r));
    sum.cost += loss.Cost(r * r);
  }
  return sum;
}

Rigid3 MinimiseEpipolarResiduals(const Rigid3& initial,
                                 std::span<const Vector3d> bearings_a,
                                 std::span<const Vector3d> bearings_b,
                                 double loss_scale_rad,
                                 int max_steps) {
  const auto linearise = [&](const Rigid3& pose) {
    return LineariseEpipolarResiduals(pose, bearings_a, bearings_b, loss_scale_rad);
  };
  return MinimiseLevenbergMarquardt<5>(
      initial, linearise, MoveRelativePose, {.max_steps = max_steps});
}

}  // namespace orbweave
