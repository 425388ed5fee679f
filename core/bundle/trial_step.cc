// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/trial_step.h"

#include <cmath>

#include "core/base/parallel_for.h"
#include "core/bundle/observation_term.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

// W^T step, W^T = M [-[d]x; -I] summed over the observations of one point.
Eigen::Vector3d PullOfPoses(const BundleLayout& layout,
                            const PackedPoint& point,
                            const BundleState& state,
                            const std::vector<Vector6>& step,
                            const RobustLoss& loss) {
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();
  for (uint32_t k = point.first; k < point.end; ++k) {
    const PackedObservation& seen = layout.observations[k];
    const uint32_t block = layout.pose_block[seen.pose];
    if (block == kHeld) continue;
    const PoseState& pose = state.poses[seen.pose];
    const ObservationTerm term =
        LineariseObservation(layout.residual, seen, pose, state.points[point.point], loss);
    const Eigen::Vector3d shift = step[block].head<3>().cross(term.d) - step[block].tail<3>();
    pull += term.hessian * shift;
  }
  return pull;
}

double SumInOrder(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum;
}

}  // namespace

PointCost EvaluatePointCost(const BundleLayout& layout,
                            const PackedPoint& point,
                            const Eigen::Vector3d& point_in_world,
                            const std::vector<PoseState>& poses,
                            const RobustLoss& loss) {
  PointCost result;
  RobustLoss::Sum sum(loss);
  for (uint32_t k = point.first; k < point.end; ++k) {
    const PackedObservation& seen = layout.observations[k];
    const PoseState& pose = poses[seen.pose];
    const BearingAngle angle = EvaluateObservation(layout.residual, seen, pose, point_in_world);
    sum.Add(angle.squared_angle * seen.weight);
    result.any_behind |= angle.behind;
  }
  result.cost = 0.5 * sum.Value();
  return result;
}

PointCosts EvaluatePointCosts(const BundleLayout& layout,
                              const BundleState& state,
                              const RobustLoss& loss,
                              int num_threads) {
  PointCosts costs;
  costs.per_point.resize(layout.points.size());
  ParallelFor(layout.chunks.size(), num_threads, [&](size_t c) {
    for (uint32_t p = layout.chunks[c].first_point; p < layout.chunks[c].end_point; ++p) {
      const PackedPoint& point = layout.points[p];
      costs.per_point[p] =
          EvaluatePointCost(layout, point, state.points[point.point], state.poses, loss).cost;
    }
  });
  costs.total = SumInOrder(costs.per_point);
  return costs;
}

void StepBlocks(const BundleLayout& layout,
                const BundleState& state,
                const std::vector<Vector6>& step,
                BundleState& trial) {
  trial.poses = state.poses;
  trial.biases = state.biases;
  for (size_t i = 0; i < trial.poses.size(); ++i) {
    if (layout.pose_block[i] == kHeld) continue;
    PoseState& pose = trial.poses[i];
    const Vector6& delta = step[layout.pose_block[i]];
    pose = MakePoseState((pose.rotation * RotationFromVector(delta.head<3>())).normalized(),
                         pose.centre + delta.tail<3>());
  }
  for (size_t g = 0; g < trial.biases.size(); ++g) {
    if (layout.bias_block[g] != kHeld) trial.biases[g] += step[layout.bias_block[g]].tail<3>();
  }
}

PointStepper::PointStepper(const BundleLayout& layout, int num_threads)
    : layout_(layout), num_threads_(num_threads), chunk_decrease_(layout.chunks.size()) {}

double PointStepper::StepPoints(const BundleState& state,
                                const RobustLoss& loss,
                                const std::vector<Vector6>& step,
                                const ReducedSystem& system,
                                const PointCosts& costs,
                                BundleState& trial,
                                PointCosts& trial_costs) {
  trial_costs.per_point.resize(layout_.points.size());
  const auto step_point = [&](uint32_t p) {
    const PackedPoint& point = layout_.points[p];
    const PointFactor& factor = system.points[p];
    const Eigen::Vector3d& before = state.points[point.point];
    Eigen::Vector3d delta = Eigen::Vector3d::Zero();
    if (!point.is_fixed) {
      const Eigen::Vector3d pull = PullOfPoses(layout_, point, state, step, loss);
      const Eigen::Matrix3d G = factor.G();
      delta = -(G * (G.transpose() * (factor.gradient + pull)));
    }
    const auto after = [&](size_t share) -> Eigen::Vector3d {
      return before + kStepShares[share] * delta;
    };
    const auto cost_at = [&](size_t share) {
      return EvaluatePointCost(layout_, point, after(share), trial.poses, loss);
    };
    const PointChoice choice = point.is_fixed ? PointChoice{.cost = cost_at(0).cost}
                                              : ChoosePointStep(costs.per_point[p], cost_at);
    trial.points[point.point] = after(choice.share);
    trial_costs.per_point[p] = choice.cost;
    return 0.5 * (factor.mu * delta.squaredNorm() - factor.gradient.dot(delta));
  };
  ParallelFor(layout_.chunks.size(), num_threads_, [&](size_t c) {
    chunk_decrease_[c] = 0.0;
    for (uint32_t p = layout_.chunks[c].first_point; p < layout_.chunks[c].end_point; ++p) {
      chunk_decrease_[c] += step_point(p);
    }
  });
  trial_costs.total = SumInOrder(trial_costs.per_point);
  return SumInOrder(chunk_decrease_);
}

}  // namespace orbweave
