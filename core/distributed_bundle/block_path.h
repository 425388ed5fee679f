// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/bundle/levenberg_marquardt.h"
#include "core/distributed_bundle/block_solver.h"
#include "core/distributed_bundle/solve_along_tree.h"

namespace orbweave {

/// Where Levenberg-Marquardt over blocks stands between two half-steps, whoever computes them: a
/// plain value that grows with the number of blocks and separators, not of points. The steps are
/// those of AdjustBundle to rounding.
struct BlockPath {
  LevenbergMarquardt steps{};
  double separators_decrease = 0.0;         ///< predicted of the step that is being tried
  std::vector<ShortenedPoint> shortened{};  ///< in the state that counts, ascending
  std::vector<std::vector<SeparatorId>> separators_of_block{};
};

/// Before the first step, from the cost and the separators of every block.
[[nodiscard]] BlockPath StartBlockPath(std::span<const double> cost_of_block,
                                       std::vector<std::vector<SeparatorId>> separators_of_block,
                                       const BundleOptions& options);

/// The step to try, from every block's system at the state that counts. nullopt where the sum is
/// not positive definite: the path then asks for more damping, or has ended (WantsStep).
[[nodiscard]] std::optional<SeparatorSolution> SolveBlockStep(BlockPath& path,
                                                              std::vector<SeparatorSystem> systems);

/// Takes the step that was tried or refuses it (path.steps.accepted), from every block's cost.
void JudgeBlockStep(BlockPath& path,
                    std::span<const TrialCost> cost_of_block,
                    const BundleOptions& options);

}  // namespace orbweave
