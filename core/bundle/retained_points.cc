// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/retained_points.h"

#include "core/bundle/observation_term.h"
#include "core/bundle/trial_step.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using Matrix63 = Eigen::Matrix<double, 6, 3>;

Eigen::Vector3d PointStep(const BundleLayout& layout, size_t k, const std::vector<Vector6>& step) {
  return step[layout.first_retained_point + k].tail<3>();
}

void AddObservation(const PackedObservation& seen,
                    uint32_t point_block,
                    const Eigen::Vector3d& point_in_world,
                    const BundleLayout& layout,
                    const BundleState& state,
                    const RobustLoss& loss,
                    ReducedSystem& system) {
  const PoseState& pose = state.poses[seen.pose];
  const ObservationTerm term =
      LineariseObservation(layout.residual, seen, pose, point_in_world, loss);
  const Eigen::Matrix3d& M = term.hessian;
  const Eigen::Vector3d& g = term.gradient;
  const auto add = [&](uint32_t block, const Block6& hessian, const Vector6& gradient) {
    system.S.Diagonal(block) += hessian;
    system.trace[block] += Eigen::Vector2d(hessian.topLeftCorner<3, 3>().trace(),
                                           hessian.bottomRightCorner<3, 3>().trace());
    system.gradient[block] += gradient;
    system.rhs[block] -= gradient;
  };
  Matrix63 I;  // of the point in its block
  I << Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Identity();
  add(point_block, I * M * I.transpose(), I * g);
  const uint32_t pose_block = layout.pose_block[seen.pose];
  if (pose_block == kHeld) return;
  Matrix63 J;  // d X / d (w, C), transposed
  J << SkewSymmetric(term.d), -Eigen::Matrix3d::Identity();
  add(pose_block, J * M * J.transpose(), J * g);
  system.S.values[system.S.Find({.column = point_block, .row = pose_block})] +=
      J * M * I.transpose();
}

}  // namespace

void AddRetainedPoints(const BundleLayout& layout,
                       const BundleState& state,
                       const RobustLoss& loss,
                       ReducedSystem& system) {
  for (uint32_t k = 0; k < layout.retained_points.size(); ++k) {
    const PackedPoint& point = layout.retained_points[k];
    for (uint32_t i = point.first; i < point.end; ++i) {
      AddObservation(layout.observations[i],
                     layout.first_retained_point + k,
                     state.points[point.point],
                     layout,
                     state,
                     loss,
                     system);
    }
  }
}

void StepRetainedPoints(const BundleLayout& layout,
                        const BundleState& state,
                        const std::vector<Vector6>& step,
                        BundleState& trial) {
  for (size_t k = 0; k < layout.retained_points.size(); ++k) {
    const uint32_t point = layout.retained_points[k].point;
    trial.points[point] = state.points[point] + PointStep(layout, k, step);
  }
}

std::vector<RetainedPointTrial> EvaluateRetainedPoints(const BundleLayout& layout,
                                                       const BundleState& state,
                                                       const std::vector<Vector6>& step,
                                                       const BundleState& trial,
                                                       const RobustLoss& loss) {
  std::vector<RetainedPointTrial> trials;
  for (size_t k = 0; k < layout.retained_points.size(); ++k) {
    const PackedPoint& point = layout.retained_points[k];
    const Eigen::Vector3d& before = state.points[point.point];
    RetainedPointTrial& costs = trials.emplace_back();
    costs.cost_before = EvaluatePointCost(layout, point, before, state.poses, loss).cost;
    for (size_t i = 0; i < kStepShares.size(); ++i) {
      const Eigen::Vector3d after = before + kStepShares[i] * PointStep(layout, k, step);
      costs.after[i] = EvaluatePointCost(layout, point, after, trial.poses, loss);
    }
  }
  return trials;
}

}  // namespace orbweave
