// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/solve_along_tree.h"

#include <gtest/gtest.h>

#include "core/partitioned_ba/subproblem_eliminator.h"
#include "tests/core/partitioned_ba/corridor_problem.h"
#include "tests/support/partitioned_ba/divide_bundle.h"

namespace orbweave {
namespace {

constexpr StepControl kControl{.lambda = 1e-6};

struct Linearized {
  std::vector<std::vector<SeparatorId>> separators{};
  std::vector<SeparatorSystem> systems{};
};

Linearized LinearizeGrid() {
  const BundleProblem problem =
      MakeCorridorProblem({.shape = CorridorShape::kGrid, .has_priors = true});
  Linearized grid;
  for (const BundleSubproblem& subproblem : DivideBundle(problem, ConsecutiveOwners(60, 13), 13)) {
    SubproblemEliminator solver(subproblem, {}, 1);
    grid.separators.push_back(subproblem.separators);
    grid.systems.push_back(solver.Linearise(solver.Start().state, kControl));
  }
  return grid;
}

TEST(SolveAlongTree, GivesTheStepOfTheWholeSumForAnyTree) {
  const Linearized grid = LinearizeGrid();
  const std::optional<SeparatorStep> whole =
      SolveSeparators(AddSystems(grid.systems), {}, kControl.lambda);
  ASSERT_TRUE(whole.has_value());
  for (const int doublings : {0, 1, 2, 3}) {
    const std::optional<SeparatorSolution> solution = SolveAlongTree(
        MakeSeparatorTree(grid.separators, doublings), grid.systems, kControl.lambda);
    ASSERT_TRUE(solution.has_value());
    EXPECT_NEAR(
        solution->predicted_decrease, whole->predicted_decrease, 1e-9 * whole->predicted_decrease);
    for (size_t b = 0; b < grid.separators.size(); ++b) {
      const SeparatorStep expected = Restricted(*whole, grid.separators[b]);
      const SeparatorStep& step = solution->step_of_subproblem[b];
      ASSERT_EQ(step.variables, expected.variables);
      for (size_t i = 0; i < step.steps.size(); ++i) {
        EXPECT_LT((step.steps[i] - expected.steps[i]).norm(), 1e-8);
      }
    }
  }
}

TEST(SolveAlongTree, FailsWhenASubproblemDid) {
  Linearized grid = LinearizeGrid();
  grid.systems[4] = {.is_definite = false};
  for (const int doublings : {0, 1}) {
    EXPECT_FALSE(SolveAlongTree(MakeSeparatorTree(grid.separators, doublings), grid.systems, 1.0)
                     .has_value());
  }
}

TEST(SolveAlongTree, OfASubproblemWithoutSeparatorsIsEmpty) {
  const std::optional<SeparatorSolution> solution =
      SolveAlongTree(MakeSeparatorTree({{}}, 3), std::vector<SeparatorSystem>(1), 1.0);
  ASSERT_TRUE(solution.has_value());
  EXPECT_TRUE(solution->step_of_subproblem.at(0).variables.empty());
  EXPECT_EQ(solution->predicted_decrease, 0.0);
}

}  // namespace
}  // namespace orbweave
