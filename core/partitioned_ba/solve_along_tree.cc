// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/solve_along_tree.h"

#include <algorithm>
#include <utility>

namespace orbweave {

std::optional<SeparatorSolution> SolveAlongTree(const SeparatorTree& tree,
                                                std::vector<SeparatorSystem> systems,
                                                double lambda) {
  SeparatorSolution solution;
  std::vector<SeparatorSystem> sums;  // of each node's children
  std::vector<std::vector<SeparatorId>> variables;
  for (const SeparatorSystem& system : systems) variables.push_back(system.variables);
  for (const SeparatorNode& node : tree.nodes) {
    std::vector<SeparatorSystem> children;
    for (const uint32_t child : node.children) children.push_back(std::move(systems[child]));
    sums.push_back(AddSystems(children));
    variables.push_back(node.retained);
    if (sums.size() == tree.nodes.size()) break;  // the root keeps nothing
    systems.push_back(EliminateSeparators(sums.back(), node.retained, lambda));
    solution.largest_node_bytes =
        std::max(solution.largest_node_bytes, PayloadBytes(systems.back()));
  }
  std::vector<SeparatorStep> steps(variables.size());
  for (size_t n = tree.nodes.size(); n-- > 0;) {
    const std::optional<SeparatorStep> step =
        SolveSeparators(sums[n], steps[tree.num_subproblems + n], lambda);
    if (!step) return std::nullopt;
    solution.predicted_decrease += step->predicted_decrease;
    for (const uint32_t child : tree.nodes[n].children) {
      steps[child] = Restricted(*step, variables[child]);
    }
  }
  steps.resize(tree.num_subproblems);
  solution.step_of_subproblem = std::move(steps);
  return solution;
}

}  // namespace orbweave
