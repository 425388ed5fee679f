// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/partitioned_ba/subproblem_eliminator.h"

namespace orbweave {

/// The whole problem's answer to a step.
struct JudgedTrial {
  double cost = 0.0;
  double predicted_decrease = 0.0;
  std::vector<ShortenedPoint> shortened{};  ///< ascending
};

/// Sums over the subproblems, in order; decides for each separator point how much of its step it
/// takes. `separators[b]` are subproblem b's, `costs[b]` its answer; `separators_decrease` is the
/// part that was predicted while separators were solved.
[[nodiscard]] JudgedTrial JudgeTrial(std::span<const std::vector<SeparatorId>> separators,
                                     std::span<const TrialCost> costs,
                                     double separators_decrease);

}  // namespace orbweave
