// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/partitioned_ba/separator_system.h"
#include "core/partitioned_ba/separator_tree.h"

namespace orbweave {

struct SeparatorSolution {
  std::vector<SeparatorStep> step_of_subproblem{};  ///< of the subproblem's separators
  double predicted_decrease = 0.0;                  ///< the separators' part
  size_t largest_node_bytes = 0;                    ///< of a remaining system
};

/// Solves for all separators: systems are added and eliminated up the tree, steps come down.
/// nullopt when a system is not positive definite. What each node does is EliminateSeparators and
/// SolveSeparators of AddSystems of its children, so that nodes may be separate tasks.
[[nodiscard]] std::optional<SeparatorSolution> SolveAlongTree(const SeparatorTree& tree,
                                                              std::vector<SeparatorSystem> systems,
                                                              double lambda);

}  // namespace orbweave
