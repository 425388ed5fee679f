// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/bundle/levenberg_marquardt.h"
#include "core/partitioned_ba/solve_along_tree.h"
#include "core/partitioned_ba/subproblem_eliminator.h"

namespace orbweave {

/// Where Levenberg-Marquardt over subproblems stands between two half-steps, whoever computes them:
/// a plain value that grows with the number of subproblems and separators, not of points. The steps
/// are those of AdjustBundle to rounding.
struct PartitionedLm {
  LevenbergMarquardt steps{};
  double separators_decrease = 0.0;         ///< predicted of the step that is being tried
  std::vector<ShortenedPoint> shortened{};  ///< in the state that counts, ascending
  std::vector<std::vector<SeparatorId>> separators_of_subproblem{};
};

/// Before the first step, from the cost and the separators of every subproblem.
[[nodiscard]] PartitionedLm StartPartitionedLm(
    std::span<const double> cost_of_subproblem,
    std::vector<std::vector<SeparatorId>> separators_of_subproblem,
    const BundleOptions& options);

/// The step to try, from every subproblem's system at the state that counts. nullopt where the sum
/// is not positive definite: the path then asks for more damping, or has ended (WantsStep).
[[nodiscard]] std::optional<SeparatorSolution> SolvePartitionedStep(
    PartitionedLm& path, std::vector<SeparatorSystem> systems);

/// Takes the step that was tried or refuses it (path.steps.accepted), from every subproblem's cost.
void JudgePartitionedStep(PartitionedLm& path,
                          std::span<const TrialCost> cost_of_subproblem,
                          const BundleOptions& options);

}  // namespace orbweave
