// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/bundle/bearing_term.h"
#include "core/bundle/bundle_layout.h"
#include "core/bundle/bundle_state.h"
#include "core/bundle/robust_loss.h"

namespace orbweave {

/// One observation's part of the normal equations under its loss. By the centre C the gradient and
/// Hessian change sign; by the rotation R exp([w]x) they are multiplied from the left by [d]x: that
/// holds for any residual of the ray R d in the camera frame.
struct ObservationTerm {
  Eigen::Vector3d d = Eigen::Vector3d::Zero();         ///< X - C
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();   ///< J^T J by the point
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  ///< J^T r by the point
};

/// With BundleResidual::kErpPx.
[[nodiscard]] ObservationTerm LineariseErpObservation(const PackedObservation& seen,
                                                      const PoseState& pose,
                                                      const Eigen::Vector3d& point_in_world,
                                                      const RobustLoss& loss);
[[nodiscard]] BearingAngle EvaluateErpObservation(const PackedObservation& seen,
                                                  const PoseState& pose,
                                                  const Eigen::Vector3d& point_in_world);

[[nodiscard]] inline ObservationTerm LineariseObservation(BundleResidual residual,
                                                          const PackedObservation& seen,
                                                          const PoseState& pose,
                                                          const Eigen::Vector3d& point_in_world,
                                                          const RobustLoss& loss) {
  if (residual == BundleResidual::kErpPx) [[unlikely]]
    return LineariseErpObservation(seen, pose, point_in_world, loss);
  BearingTerm term =
      LineariseBearing(pose.centre, point_in_world, pose.world_from_cam * seen.bearing);
  const double weight = ApplyLoss(loss, seen.weight, term);
  return {term.d, PointHessian(term, weight), PointGradient(term, weight)};
}

/// The squared length of the residual, without its weight, and whether the ray lies behind.
[[nodiscard]] inline BearingAngle EvaluateObservation(BundleResidual residual,
                                                      const PackedObservation& seen,
                                                      const PoseState& pose,
                                                      const Eigen::Vector3d& point_in_world) {
  if (residual == BundleResidual::kErpPx) [[unlikely]]
    return EvaluateErpObservation(seen, pose, point_in_world);
  return EvaluateBearing(pose.centre, point_in_world, pose.world_from_cam * seen.bearing);
}

}  // namespace orbweave
