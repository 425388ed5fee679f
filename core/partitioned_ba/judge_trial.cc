// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/judge_trial.h"

#include <map>

namespace orbweave {
namespace {

void Add(const RetainedPointTrial& term, RetainedPointTrial& sum) {
  sum.cost_before += term.cost_before;
  for (size_t i = 0; i < sum.after.size(); ++i) {
    sum.after[i].cost += term.after[i].cost;
    sum.after[i].any_behind |= term.after[i].any_behind;
  }
}

}  // namespace

JudgedTrial JudgeTrial(std::span<const std::vector<SeparatorId>> separators,
                       std::span<const TrialCost> costs,
                       double separators_decrease) {
  JudgedTrial judged{.predicted_decrease = separators_decrease};
  std::map<uint32_t, RetainedPointTrial> points;
  for (size_t b = 0; b < costs.size(); ++b) {
    judged.cost += costs[b].cost;
    judged.predicted_decrease += costs[b].predicted_decrease;
    size_t retained = 0;
    for (const SeparatorId& id : separators[b]) {
      if (id.kind == SeparatorId::Kind::kPoint)
        Add(costs[b].retained_points[retained++], points[id.index]);
    }
  }
  for (const auto& [point, sum] : points) {
    const RetainedPointTrial& trial = sum;  // clang 14 captures no structured binding
    const PointChoice choice =
        ChoosePointStep(trial.cost_before, [&](size_t share) { return trial.after[share]; });
    judged.cost += choice.cost;
    if (choice.share == 0) continue;
    judged.shortened.push_back({.point = point, .share = kStepShares[choice.share]});
  }
  return judged;
}

}  // namespace orbweave
