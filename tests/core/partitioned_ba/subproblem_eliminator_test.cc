// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/subproblem_eliminator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/bundle/adjust_bundle.h"
#include "core/bundle/bundle_report.h"
#include "core/partitioned_ba/judge_trial.h"
#include "core/partitioned_ba/solve_along_tree.h"
#include "tests/core/partitioned_ba/corridor_problem.h"
#include "tests/support/partitioned_ba/divide_bundle.h"

namespace orbweave {
namespace {

/// The two half-steps as pure functions: the second linearises again instead of holding anything.
SeparatorSystem LineariseSubproblem(const BundleSubproblem& subproblem,
                                    const EvaluatedState& state,
                                    const StepControl& control,
                                    const BundleOptions& options,
                                    int num_threads) {
  return SubproblemEliminator(subproblem, options, num_threads).Linearise(state, control);
}

SubproblemTrial BackSubstituteSubproblem(const BundleSubproblem& subproblem,
                                         const EvaluatedState& state,
                                         const StepControl& control,
                                         const SeparatorStep& step,
                                         const BundleOptions& options,
                                         int num_threads) {
  SubproblemEliminator solver(subproblem, options, num_threads);
  // Deterministic: it was definite when the separators were solved.
  ORBWEAVE_CHECK(solver.Linearise(state, control).is_definite);
  return solver.BackSubstitute(state, step);
}

constexpr StepControl kControl{.lambda = 1e-6};

std::vector<BundleSubproblem> Subproblems() {
  return DivideBundle(
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

bool SameTrials(const SubproblemTrial& a, const SubproblemTrial& b) {
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
SeparatorStep StepOf(const BundleSubproblem& subproblem) {
  SeparatorStep step{.variables = subproblem.separators};
  Random random(7);
  for (size_t i = 0; i < subproblem.separators.size(); ++i) {
    Vector6 delta = Vector6::Zero();
    delta.tail<3>() = NoiseVector(random, 0.01);
    step.steps.push_back(delta);
  }
  return step;
}

TEST(SubproblemEliminator, RepeatsEachHalfStepBitForBit) {
  for (const BundleSubproblem& subproblem : Subproblems()) {
    SubproblemEliminator held(subproblem, {}, 1);
    const EvaluatedState start = held.Start().state;
    const SeparatorSystem system = held.Linearise(start, kControl);
    EXPECT_TRUE(SameSystems(system, LineariseSubproblem(subproblem, start, kControl, {}, 2)));
    const SeparatorStep step = StepOf(subproblem);
    const SubproblemTrial trial = held.BackSubstitute(start, step);
    EXPECT_TRUE(
        SameTrials(trial, BackSubstituteSubproblem(subproblem, start, kControl, step, {}, 2)));
    // Again, after other work in between.
    (void)held.Linearise(trial.state, {.lambda = 1.0, .is_bent = true});
    EXPECT_TRUE(SameSystems(system, held.Linearise(start, kControl)));
    EXPECT_TRUE(SameTrials(trial, held.BackSubstitute(start, step)));
  }
}

TEST(SubproblemEliminator, MovesCopiesOfASeparatorAlike) {
  const std::vector<BundleSubproblem> subproblems = Subproblems();
  std::map<uint32_t, Eigen::Vector3d> moved;
  size_t num_shared = 0;
  for (const BundleSubproblem& subproblem : subproblems) {
    SubproblemEliminator solver(subproblem, {}, 1);
    const EvaluatedState start = solver.Start().state;
    (void)solver.Linearise(start, kControl);
    SeparatorStep step{.variables = subproblem.separators};
    for (const SeparatorId& id : subproblem.separators) {
      step.steps.push_back(Vector6::Constant(1e-3 * id.index));
    }
    const SubproblemTrial trial = solver.BackSubstitute(start, step);
    for (size_t i = 0; i < subproblem.pose_ids.size(); ++i) {
      const SeparatorId id{SeparatorId::Kind::kPose, subproblem.pose_ids[i]};
      if (!std::binary_search(subproblem.separators.begin(), subproblem.separators.end(), id))
        continue;
      const Eigen::Vector3d& centre = trial.state.variables.poses[i].centre;
      const auto [it, is_new] = moved.emplace(id.index, centre);
      if (is_new) continue;
      ++num_shared;
      EXPECT_TRUE(SameBytes(it->second, centre));
    }
  }
  EXPECT_GT(num_shared, 0U);
}

// A point that two distant subproblems share, taken for much farther than it is: its step is a leap
// to behind the street.
TEST(SubproblemEliminator, ShortensTheLeapOfASeparatorPointAsOneProcessDoes) {
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
  const std::vector<BundleSubproblem> subproblems =
      DivideBundle(problem, ConsecutiveOwners(60, 5), 5);
  ASSERT_EQ(subproblems[0].separators.back(), (SeparatorId{SeparatorId::Kind::kPoint, point}));
  std::vector<std::vector<SeparatorId>> separators;
  std::vector<SeparatorSystem> systems;
  std::vector<EvaluatedState> starts;
  for (const BundleSubproblem& subproblem : subproblems) {
    separators.push_back(subproblem.separators);
    starts.push_back(SubproblemEliminator(subproblem, {}, 1).Start().state);
    systems.push_back(LineariseSubproblem(subproblem, starts.back(), kControl, {}, 1));
  }
  const std::optional<SeparatorSolution> solution =
      SolveAlongTree(MakeSeparatorTree(separators, 1), systems, kControl.lambda);
  ASSERT_TRUE(solution.has_value());
  std::vector<TrialCost> costs;
  for (size_t b = 0; b < subproblems.size(); ++b) {
    const SeparatorStep& step = solution->step_of_subproblem[b];
    costs.push_back(
        BackSubstituteSubproblem(subproblems[b], starts[b], kControl, step, {}, 1).cost);
  }
  const JudgedTrial judged = JudgeTrial(separators, costs, solution->predicted_decrease);
  ASSERT_EQ(judged.shortened.size(), 1U);
  EXPECT_EQ(judged.shortened[0].point, point);
  const absl::StatusOr<BundleReport> one = AdjustBundle(problem, {.max_iterations = 1}, {});
  ASSERT_TRUE(one.ok());
  EXPECT_NEAR(judged.cost, one->final_cost, 1e-9 * one->final_cost);
}

TEST(SubproblemEliminator, AcceptedShortensSharedPoints) {
  BundleSubproblem subproblem;
  subproblem.point_ids = {3, 7, 9};
  subproblem.separators = {{SeparatorId::Kind::kPoint, 7}, {SeparatorId::Kind::kPoint, 9}};
  EvaluatedState trial;
  trial.variables.points.assign(3, Eigen::Vector3d::Constant(4.0));
  trial.retained_points_before.assign(2, Eigen::Vector3d::Zero());
  const EvaluatedState accepted = Accepted(subproblem, trial, {{.point = 9, .share = 0.25}});
  EXPECT_EQ(accepted.variables.points[1], Eigen::Vector3d::Constant(4.0));
  EXPECT_EQ(accepted.variables.points[2], Eigen::Vector3d::Constant(1.0));
}

}  // namespace
}  // namespace orbweave
