// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/partitioned_lm.h"

#include <utility>

#include "core/partitioned_ba/judge_trial.h"
#include "core/partitioned_ba/separator_tree.h"

namespace orbweave {

PartitionedLm StartPartitionedLm(std::span<const double> cost_of_subproblem,
                                 std::vector<std::vector<SeparatorId>> separators_of_subproblem,
                                 const BundleOptions& options) {
  double cost = 0.0;
  for (const double subproblem_cost : cost_of_subproblem) cost += subproblem_cost;
  return {.steps = StartLevenbergMarquardt(cost, options),
          .separators_of_subproblem = std::move(separators_of_subproblem)};
}

std::optional<SeparatorSolution> SolvePartitionedStep(PartitionedLm& path,
                                                      std::vector<SeparatorSystem> systems) {
  std::optional<SeparatorSolution> solution =
      SolveAlongTree(MakeSeparatorTree(path.separators_of_subproblem),
                     std::move(systems),
                     path.steps.control.lambda);
  if (solution) {
    path.separators_decrease = solution->predicted_decrease;
  } else {
    path.steps = AfterFailure(path.steps);
  }
  return solution;
}

void JudgePartitionedStep(PartitionedLm& path,
                          std::span<const TrialCost> cost_of_subproblem,
                          const BundleOptions& options) {
  JudgedTrial judged =
      JudgeTrial(path.separators_of_subproblem, cost_of_subproblem, path.separators_decrease);
  path.steps = AfterTrial(path.steps, judged.cost, judged.predicted_decrease, options);
  if (path.steps.accepted) path.shortened = std::move(judged.shortened);
}

}  // namespace orbweave
