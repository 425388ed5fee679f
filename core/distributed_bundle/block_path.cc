// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/distributed_bundle/block_path.h"

#include <utility>

#include "core/distributed_bundle/judge_trial.h"
#include "core/distributed_bundle/separator_tree.h"

namespace orbweave {

BlockPath StartBlockPath(std::span<const double> cost_of_block,
                         std::vector<std::vector<SeparatorId>> separators_of_block,
                         const BundleOptions& options) {
  double cost = 0.0;
  for (const double block_cost : cost_of_block) cost += block_cost;
  return {.steps = StartLevenbergMarquardt(cost, options),
          .separators_of_block = std::move(separators_of_block)};
}

std::optional<SeparatorSolution> SolveBlockStep(BlockPath& path,
                                                std::vector<SeparatorSystem> systems) {
  std::optional<SeparatorSolution> solution = SolveAlongTree(
      MakeSeparatorTree(path.separators_of_block), std::move(systems), path.steps.control.lambda);
  if (solution) {
    path.separators_decrease = solution->predicted_decrease;
  } else {
    path.steps = AfterFailure(path.steps);
  }
  return solution;
}

void JudgeBlockStep(BlockPath& path,
                    std::span<const TrialCost> cost_of_block,
                    const BundleOptions& options) {
  JudgedTrial judged =
      JudgeTrial(path.separators_of_block, cost_of_block, path.separators_decrease);
  path.steps = AfterTrial(path.steps, judged.cost, judged.predicted_decrease, options);
  if (path.steps.accepted) path.shortened = std::move(judged.shortened);
}

}  // namespace orbweave
