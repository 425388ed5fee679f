// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/bundle_eliminator.h"

#include "core/bundle/prior_terms.h"

namespace orbweave {
namespace {

std::vector<uint8_t> RetainedBlocks(const BundleLayout& layout, const RetainedVariables& retained) {
  std::vector<uint8_t> is_retained(layout.num_blocks, 0);
  for (const uint32_t pose : retained.poses) is_retained[layout.pose_block[pose]] = 1;
  for (const uint32_t bias : retained.biases) is_retained[layout.bias_block[bias]] = 1;
  for (uint32_t k = layout.first_retained_point; k < layout.num_blocks; ++k) is_retained[k] = 1;
  return is_retained;
}

}  // namespace

BundleEliminator::BundleEliminator(const BundleProblem& problem,
                                   const Gauge& gauge,
                                   const RetainedVariables& retained,
                                   const BundleOptions& options,
                                   int num_threads)
    : problem_(problem),
      gauge_(gauge),
      num_threads_(num_threads),
      loss_(options.loss, options.loss_scale),
      layout_(MakeBundleLayout(problem, gauge, retained.points)),
      elimination_(layout_.matrix, RetainedBlocks(layout_, retained)),
      reducer_(layout_, num_threads),
      stepper_(layout_, num_threads),
      system_(MakeReducedSystem(layout_)) {
  layout_.residual = options.residual;
}

EvaluatedState BundleEliminator::Start() const {
  EvaluatedState state{.variables = InitialState(problem_)};
  state.costs = EvaluatePointCosts(layout_, state.variables, loss_, num_threads_);
  for (const PackedPoint& point : layout_.retained_points) {
    state.retained_points_before.push_back(state.variables.points[point.point]);
  }
  return state;
}

double BundleEliminator::Cost(const EvaluatedState& state) const {
  double cost = state.costs.total + PriorCost(problem_, state.variables);
  for (const PackedPoint& point : layout_.retained_points) {
    const Eigen::Vector3d& point_in_world = state.variables.points[point.point];
    cost += EvaluatePointCost(layout_, point, point_in_world, state.variables.poses, loss_).cost;
  }
  return cost;
}

bool BundleEliminator::Linearise(const EvaluatedState& state, const StepControl& control) {
  loss_ = loss_.Bent(control.is_bent);
  Clear(system_);
  reducer_.AddBearings(state.variables, loss_, control.lambda, system_);
  AddRetainedPoints(layout_, state.variables, loss_, system_);
  AddPriorTerms(problem_, layout_, state.variables, system_);
  AddDistanceSpring(gauge_, layout_, state.variables, system_);
  return elimination_.Eliminate(control.lambda, system_);
}

TrialCost BundleEliminator::BackSubstitute(const EvaluatedState& state,
                                           const std::vector<Vector6>& retained_step,
                                           EvaluatedState& trial) {
  const std::vector<Vector6> step = elimination_.BackSubstitute(retained_step);
  StepBlocks(layout_, state.variables, step, trial.variables);
  trial.variables.points = state.variables.points;
  trial.retained_points_before.clear();
  for (const PackedPoint& point : layout_.retained_points) {
    trial.retained_points_before.push_back(state.variables.points[point.point]);
  }
  StepRetainedPoints(layout_, state.variables, step, trial.variables);

  TrialCost cost;
  cost.predicted_decrease =
      elimination_.PredictedDecrease(system_, step) +
      stepper_.StepPoints(
          state.variables, loss_, step, system_, state.costs, trial.variables, trial.costs);
  cost.cost = trial.costs.total + PriorCost(problem_, trial.variables);
  cost.retained_points =
      EvaluateRetainedPoints(layout_, state.variables, step, trial.variables, loss_);
  return cost;
}

void WriteBack(const BundleLayout& layout, const BundleState& state, BundleProblem& problem) {
  for (size_t i = 0; i < state.poses.size(); ++i) {
    if (layout.pose_block[i] == kHeld) continue;
    problem.cams_from_world[i] = Rigid3::FromCentre(state.poses[i].rotation, state.poses[i].centre);
  }
  problem.points_in_world = state.points;
}

}  // namespace orbweave
