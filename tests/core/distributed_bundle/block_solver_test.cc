// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/distributed_bundle/block_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/distributed_bundle/divide_into_blocks.h"
#include "core/distributed_bundle/judge_trial.h"
#include "core/distributed_bundle/solve_along_tree.h"
#include "tests/core/distributed_bundle/corridor_problem.h"

namespace orbweave {
namespace {

constexpr StepControl kControl{.lambda = 1e-6};

std::vector<AdjustmentBlock> Blocks() {
  return DivideIntoBlocks(
      MakeCorridorProblem(
          {.shape = CorridorShape::kGrid, .outlier_share = 0.02, .has_priors = true}),
      ConsecutiveOwners(60, 5),
      5);
}

bool SameSystems(const SeparatorSystem& a, const SeparatorSystem& b) {
  return a.variables == b.variables && a.normal.S.rows == b.normal.S.rows &&
         a.normal.S.values == b.normal.S.values && a.normal.rhs == b.normal.rhs &&
         a.normal.gradient == b.normal.gradient && a.normal.trace == b.normal.trace;
}

bool SameTrials(const BlockTrial& a, const BlockTrial& b) {
  for (size_t i = 0; i < a.state.variables.poses.size(); ++i) {
    if (a.state.variables.poses[i].rotation.coeffs() !=
        b.state.variables.poses[i].rotation.coeffs())
      return false;
    if (a.state.variables.poses[i].centre != b.state.variables.poses[i].centre) return false;
  }
  return a.state.variables.points == b.state.variables.points &&
         a.state.variables.biases == b.state.variables.biases &&
         a.state.costs.per_point == b.state.costs.per_point && a.cost.cost == b.cost.cost &&
         a.cost.predicted_decrease == b.cost.predicted_decrease;
}

// Some step of the separators.
SeparatorStep StepOf(const AdjustmentBlock& block) {
  SeparatorStep step{.variables = block.separators};
  Random random(7);
  for (size_t i = 0; i < block.separators.size(); ++i) {
    Vector6 delta = Vector6::Zero();
    delta.tail<3>() = NoiseVector(random, 0.01);
    step.steps.push_back(delta);
  }
  return step;
}

TEST(BlockSolver, RepeatsEachHalfStepBitForBit) {
  for (const AdjustmentBlock& block : Blocks()) {
    BlockSolver held(block, {}, 1);
    const EvaluatedState start = held.Start().state;
    const SeparatorSystem system = held.Linearize(start, kControl);
    EXPECT_TRUE(SameSystems(system, LinearizeBlock(block, start, kControl, {}, 2)));
    const SeparatorStep step = StepOf(block);
    const BlockTrial trial = held.BackSubstitute(start, step);
    EXPECT_TRUE(SameTrials(trial, BackSubstituteBlock(block, start, kControl, step, {}, 2)));
    // Again, after other work in between.
    (void)held.Linearize(trial.state, {.lambda = 1.0, .is_bent = true});
    EXPECT_TRUE(SameSystems(system, held.Linearize(start, kControl)));
    EXPECT_TRUE(SameTrials(trial, held.BackSubstitute(start, step)));
  }
}

TEST(BlockSolver, MovesCopiesOfASeparatorAlike) {
  const std::vector<AdjustmentBlock> blocks = Blocks();
  std::map<uint32_t, Eigen::Vector3d> moved;
  size_t num_shared = 0;
  for (const AdjustmentBlock& block : blocks) {
    BlockSolver solver(block, {}, 1);
    const EvaluatedState start = solver.Start().state;
    (void)solver.Linearize(start, kControl);
    SeparatorStep step{.variables = block.separators};
    for (const SeparatorId& id : block.separators) {
      step.steps.push_back(Vector6::Constant(1e-3 * id.index));
    }
    const BlockTrial trial = solver.BackSubstitute(start, step);
    for (size_t i = 0; i < block.pose_ids.size(); ++i) {
      const SeparatorId id{SeparatorId::Kind::kPose, block.pose_ids[i]};
      if (!std::binary_search(block.separators.begin(), block.separators.end(), id)) continue;
      const Eigen::Vector3d& centre = trial.state.variables.poses[i].centre;
      const auto [it, is_new] = moved.emplace(id.index, centre);
      if (is_new) continue;
      ++num_shared;
      EXPECT_TRUE(SameBytes(it->second, centre));
    }
  }
  EXPECT_GT(num_shared, 0U);
}

// A point that two distant blocks share, taken for much farther than it is: its step is a leap to
// behind the street.
TEST(BlockSolver, ShortensTheLeapOfASeparatorPointAsOneProcessDoes) {
  BundleProblem problem = MakeCorridorProblem({.has_fixed = true});
  const Eigen::Vector3d first = problem.cams_from_world[1].Centre();
  const Eigen::Vector3d last = problem.cams_from_world[58].Centre();
  const Eigen::Vector3d middle = 0.5 * (first + last);
  const Eigen::Vector3d aside = (last - first).cross(Eigen::Vector3d::UnitZ());
  const auto point = static_cast<uint32_t>(problem.points_in_world.size());
  problem.points_in_world.push_back(middle + 8.0 * aside);
  problem.point_is_fixed.push_back(0);
  for (const uint32_t pose : {1U, 58U}) {
    const Eigen::Vector3d bearing = problem.cams_from_world[pose] * (middle + 2.0 * aside);
    problem.observations.push_back(
        {.pose = pose, .point = point, .bearing = bearing.normalized(), .sigma_rad = 1e-3});
  }
  const std::vector<AdjustmentBlock> blocks =
      DivideIntoBlocks(problem, ConsecutiveOwners(60, 5), 5);
  ASSERT_EQ(blocks[0].separators.back(), (SeparatorId{SeparatorId::Kind::kPoint, point}));
  std::vector<std::vector<SeparatorId>> separators;
  std::vector<SeparatorSystem> systems;
  std::vector<EvaluatedState> starts;
  for (const AdjustmentBlock& block : blocks) {
    separators.push_back(block.separators);
    starts.push_back(BlockSolver(block, {}, 1).Start().state);
    systems.push_back(LinearizeBlock(block, starts.back(), kControl, {}, 1));
  }
  const std::optional<SeparatorSolution> solution =
      SolveAlongTree(MakeSeparatorTree(separators, 1), systems, kControl.lambda);
  ASSERT_TRUE(solution.has_value());
  std::vector<TrialCost> costs;
  for (size_t b = 0; b < blocks.size(); ++b) {
    const SeparatorStep& step = solution->step_of_block[b];
    costs.push_back(BackSubstituteBlock(blocks[b], starts[b], kControl, step, {}, 1).cost);
  }
  const JudgedTrial judged = JudgeTrial(separators, costs, solution->predicted_decrease);
  ASSERT_EQ(judged.shortened.size(), 1U);
  EXPECT_EQ(judged.shortened[0].point, point);
  const absl::StatusOr<BundleReport> one = AdjustBundle(problem, {.max_iterations = 1}, {});
  ASSERT_TRUE(one.ok());
  EXPECT_NEAR(judged.cost, one->final_cost, 1e-9 * one->final_cost);
}

TEST(BlockSolver, AcceptedShortensSharedPoints) {
  AdjustmentBlock block;
  block.point_ids = {3, 7, 9};
  block.separators = {{SeparatorId::Kind::kPoint, 7}, {SeparatorId::Kind::kPoint, 9}};
  EvaluatedState trial;
  trial.variables.points.assign(3, Eigen::Vector3d::Constant(4.0));
  trial.kept_points_before.assign(2, Eigen::Vector3d::Zero());
  const EvaluatedState accepted = Accepted(block, trial, {{.point = 9, .share = 0.25}});
  EXPECT_EQ(accepted.variables.points[1], Eigen::Vector3d::Constant(4.0));
  EXPECT_EQ(accepted.variables.points[2], Eigen::Vector3d::Constant(1.0));
}

}  // namespace
}  // namespace orbweave
