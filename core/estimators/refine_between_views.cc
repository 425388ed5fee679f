// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/refine_between_views.h"

#include <cmath>

#include "core/estimators/refine_absolute_pose.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kEpipole = 1e-12;  // squared sine to the baseline; closer bearings have no plane

/// Adds the matches with one view to `sum`.
void AddView(const Rigid3& cam_from_world,
             const ViewMatches& view,
             const CauchyLoss& loss,
             Linearisation<6>& sum) {
  const Rigid3 cam_from_view = cam_from_world * view.view_from_world.Inverse();
  const double baseline = cam_from_view.translation.norm();
  if (!(baseline > 0.0)) return;  // one centre: no plane
  const Vector3d T = cam_from_view.translation / baseline;
  const Matrix3d R = cam_from_view.rotation.toRotationMatrix();
  const Matrix3d across = (Matrix3d::Identity() - T * T.transpose()) / baseline;
  for (size_t i = 0; i < view.in_view.size(); ++i) {
    const Vector3d q = R * view.in_view[i];
    const Vector3d& p = view.in_image[i];
    const double along_q = T.dot(q);
    const double along_p = T.dot(p);
    const double s2 = 1.0 - 0.5 * (along_q * along_q + along_p * along_p);
    if (!(s2 > kEpipole)) continue;
    const double s = std::sqrt(s2);
    const Vector3d normal = q.cross(p);
    const double r = T.dot(normal) / s;
    const double k = r / (2.0 * s2);
    // Turning the image by theta is turning p back, dp = p x theta; moving it by gamma in its own
    // axes takes dT = -across gamma.
    const Vector3d df_dtheta = T.cross(q).cross(p);
    const Vector3d ds2_dtheta = -along_p * T.cross(p);
    const Vector3d dr_dT = normal / s + k * (along_q * q + along_p * p);
    Eigen::Matrix<double, 6, 1> J;
    J << df_dtheta / s - k * ds2_dtheta, -across * dr_dT;
    sum.Add(r, J, loss.Weight(r * r));
    sum.cost += loss.Cost(r * r);
  }
}

}  // namespace

Linearisation<6> LineariseBetweenViews(const Rigid3& cam_from_world,
                                       std::span<const ViewMatches> views,
                                       double loss_scale_rad) {
  const CauchyLoss loss(loss_scale_rad);
  Linearisation<6> sum;
  for (const ViewMatches& view : views) AddView(cam_from_world, view, loss, sum);
  return sum;
}

Rigid3 MinimiseBetweenViews(const Rigid3& initial,
                            std::span<const ViewMatches> views,
                            std::span<const Vector3d> bearings,
                            std::span<const Vector3d> points_in_world,
                            double loss_scale_rad,
                            int max_steps) {
  const auto linearise = [&](const Rigid3& pose) {
    Linearisation<6> sum = LineariseBetweenViews(pose, views, loss_scale_rad);
    const Linearisation<6> points =
        LineariseTangentResiduals(pose, bearings, points_in_world, loss_scale_rad);
    sum.H += points.H;
    sum.g += points.g;
    sum.cost += points.cost;
    return sum;
  };
  return MinimiseLevenbergMarquardt<6>(initial, linearise, MovePose, {.max_steps = max_steps});
}

}  // namespace orbweave
