// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/bundle/normal_system.h"
#include "core/partitioned_ba/bundle_subproblem.h"

namespace orbweave {

/// What one subproblem, or several together, say about separators once everything else is
/// eliminated: normal equations, undamped (a variable is damped where it is eliminated).
struct SeparatorSystem {
  std::vector<SeparatorId> variables{};  ///< ascending
  NormalSystem normal{};                 ///< a block per variable
  bool is_definite = true;               ///< false: the step failed, there is nothing else here
};

struct SeparatorStep {
  std::vector<SeparatorId> variables{};  ///< ascending
  std::vector<Vector6> steps{};          ///< biases and points have theirs last
  /// By the linear model, of the variables that were eliminated to find this step.
  double predicted_decrease = 0.0;
};

/// The sum over the union of their variables, added in the given order.
[[nodiscard]] SeparatorSystem AddSystems(std::span<const SeparatorSystem> systems);

/// What remains of `sum` for the variables `retained` (ascending, among its own); the others, which
/// nobody else may use, are damped and eliminated.
[[nodiscard]] SeparatorSystem EliminateSeparators(const SeparatorSystem& sum,
                                                  const std::vector<SeparatorId>& retained,
                                                  double lambda);

/// The step of all variables of `sum` from that of those which EliminateSeparators retained: the
/// whole solution when `retained` is empty. nullopt when the system is not positive definite.
[[nodiscard]] std::optional<SeparatorStep> SolveSeparators(const SeparatorSystem& sum,
                                                           const SeparatorStep& retained,
                                                           double lambda);

/// The steps of `variables` (ascending, among its own).
[[nodiscard]] SeparatorStep Restricted(const SeparatorStep& step,
                                       const std::vector<SeparatorId>& variables);

/// Bytes of its numbers.
[[nodiscard]] size_t PayloadBytes(const SeparatorSystem& system);

}  // namespace orbweave
