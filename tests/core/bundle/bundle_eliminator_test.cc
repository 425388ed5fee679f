// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/bundle_eliminator.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "tests/core/bundle/bundle_world.h"

namespace orbweave {
namespace {

constexpr StepControl kControl{.lambda = 1e-4};

BundleProblem WorldWithPriors() {
  BundleProblem problem = MakeBundleWorld({.num_poses = 8, .num_points = 100}).start;
  problem.bias_sigma_m = {1.0, 1.0};
  for (uint32_t pose = 0; pose < 8; ++pose) {
    const Eigen::Vector3d centre = problem.cams_from_world[pose].Centre();
    problem.position_priors.push_back({.pose = pose,
                                       .position_in_world = centre + Eigen::Vector3d(0.3, 0.1, 0),
                                       .bias_group = pose % 2});
  }
  return problem;
}

// Solves the remaining system densely, damped as it would be where it is eliminated.
std::vector<Vector6> SolveRemaining(NormalSystem system) {
  DampPoses(kControl.lambda, system);
  const Eigen::Index n = 6 * static_cast<Eigen::Index>(system.S.num_blocks);
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd rhs(n);
  for (uint32_t j = 0; j < system.S.num_blocks; ++j) {
    rhs.segment<6>(6 * j) = system.rhs[j];
    for (uint32_t p = system.S.column_start[j]; p < system.S.column_start[j + 1]; ++p) {
      S.block<6, 6>(6 * system.S.rows[p], 6 * j) = system.S.values[p];
    }
  }
  const Eigen::VectorXd x = S.selfadjointView<Eigen::Upper>().llt().solve(rhs);
  std::vector<Vector6> step;
  for (Eigen::Index i = 0; i < n; i += 6) step.emplace_back(x.segment<6>(i));
  return step;
}

double LargestDifference(const BundleState& a, const BundleState& b) {
  double largest = 0.0;
  for (size_t i = 0; i < a.poses.size(); ++i) {
    largest = std::max(largest, (a.poses[i].centre - b.poses[i].centre).norm());
    largest = std::max(largest, a.poses[i].rotation.angularDistance(b.poses[i].rotation));
  }
  for (size_t i = 0; i < a.biases.size(); ++i) {
    largest = std::max(largest, (a.biases[i] - b.biases[i]).norm());
  }
  for (size_t i = 0; i < a.points.size(); ++i) {
    largest = std::max(largest, (a.points[i] - b.points[i]).norm());
  }
  return largest;
}

EvaluatedState StepOfAll(const BundleProblem& problem, const Gauge& gauge, TrialCost& cost) {
  BundleEliminator eliminator(problem, gauge, {}, {}, 1);
  const EvaluatedState start = eliminator.Start();
  EXPECT_TRUE(eliminator.Linearise(start, kControl));
  EvaluatedState trial;
  cost = eliminator.BackSubstitute(start, {}, trial);
  return trial;
}

TEST(BundleEliminator, KeepingVariablesDoesNotChangeTheStep) {
  const BundleProblem problem = WorldWithPriors();
  const Gauge gauge = ChooseGauge(problem);
  TrialCost expected_cost;
  const EvaluatedState expected = StepOfAll(problem, gauge, expected_cost);
  const uint32_t seen = problem.observations.front().point;
  const uint32_t also_seen = problem.observations.back().point;
  for (const RetainedVariables& retained :
       {RetainedVariables{.poses = {2, 3, 7}},
        RetainedVariables{.biases = {0, 1}},
        RetainedVariables{.points = {seen, also_seen}},
        RetainedVariables{{0, 1, 2, 3, 4, 5, 6, 7}, {1}, {seen}}}) {
    BundleEliminator eliminator(problem, gauge, retained, {}, 1);
    const EvaluatedState start = eliminator.Start();
    ASSERT_TRUE(eliminator.Linearise(start, kControl));
    const NormalSystem remaining = eliminator.Remaining();
    EXPECT_EQ(remaining.S.num_blocks,
              retained.poses.size() + retained.biases.size() + retained.points.size());
    EvaluatedState trial;
    const TrialCost cost = eliminator.BackSubstitute(start, SolveRemaining(remaining), trial);
    EXPECT_LT(LargestDifference(expected.variables, trial.variables), 1e-10);
    double whole = cost.cost;
    for (const RetainedPointTrial& point : cost.retained_points) whole += point.after[0].cost;
    EXPECT_NEAR(whole, expected_cost.cost, 1e-9 * whole);
    EXPECT_LT(cost.predicted_decrease, expected_cost.predicted_decrease);
  }
}

TEST(BundleEliminator, CostIsThatOfThePathWhateverIsKept) {
  const BundleProblem problem = WorldWithPriors();
  const Gauge gauge = ChooseGauge(problem);
  const BundleEliminator nothing(problem, gauge, {}, {}, 1);
  const BundleEliminator point(
      problem, gauge, {.points = {problem.observations.front().point}}, {}, 1);
  const double cost = nothing.Cost(nothing.Start());
  EXPECT_NEAR(point.Cost(point.Start()), cost, 1e-12 * cost);
}

}  // namespace
}  // namespace orbweave
