// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/observation_term.h"

#include "core/bundle/erp_residual.h"

namespace orbweave {
namespace {

BearingResidual ErpResidualOf(const PackedObservation& seen,
                              const PoseState& pose,
                              const Eigen::Vector3d& point_in_world) {
  return EvaluateErpResidual(
      pose.world_from_cam.transpose(), pose.centre, point_in_world, seen.bearing);
}

}  // namespace

ObservationTerm LineariseErpObservation(const PackedObservation& seen,
                                        const PoseState& pose,
                                        const Eigen::Vector3d& point_in_world,
                                        const RobustLoss& loss) {
  const BearingResidual residual = ErpResidualOf(seen, pose, point_in_world);
  const double squared = residual.r.squaredNorm();
  const double weight = seen.weight * loss.Weight(seen.weight * squared);
  // As ApplyLoss does: rho' (I + bend r r^T) instead of rho' I between both Jacobians.
  constexpr double kMinBend = 0.2;
  double bend = loss.Bend(seen.weight * squared) * seen.weight;
  if (1.0 + bend * squared < kMinBend) bend = (kMinBend - 1.0) / squared;
  const Eigen::Matrix2d middle =
      Eigen::Matrix2d::Identity() + bend * residual.r * residual.r.transpose();
  const auto& J = residual.d_point;
  return {point_in_world - pose.centre,
          weight * (J.transpose() * middle * J),
          weight * (J.transpose() * residual.r)};
}

BearingAngle EvaluateErpObservation(const PackedObservation& seen,
                                    const PoseState& pose,
                                    const Eigen::Vector3d& point_in_world) {
  const Eigen::Vector3d d = point_in_world - pose.centre;
  return {ErpResidualOf(seen, pose, point_in_world).r.squaredNorm(),
          d.dot(pose.world_from_cam * seen.bearing) < 0.0};
}

}  // namespace orbweave
