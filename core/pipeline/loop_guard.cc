// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/loop_guard.h"

#include <algorithm>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

Digest DigestOfTasks(std::span<const TaskSpec> tasks) {
  std::vector<Digest> ids;
  for (const TaskSpec& task : tasks) ids.push_back(task.Id());
  return DigestOf(EncodeCollection(ids));
}

}  // namespace

absl::Status LoopGuard::Enter(const JobPlan& plan,
                              uint32_t stage,
                              std::span<const TaskSpec> tasks) {
  const std::string& name = plan.stages[stage].stage;
  const auto last = std::ranges::find(plan.stages, name, &StageRule::back_to);
  if (last == plan.stages.end()) return absl::OkStatus();
  std::set<Digest>& rounds = rounds_[stage];
  const bool is_new = rounds.insert(DigestOfTasks(tasks)).second;
  const std::string loop = absl::StrCat("the loop from ", name, " to ", last->stage);
  if (!is_new) {
    return absl::FailedPreconditionError(absl::StrCat(
        "round ", rounds.size() + 1, " of ", loop, " repeats an earlier one and would never end"));
  }
  if (rounds.size() > last->max_rounds) {
    return absl::FailedPreconditionError(
        absl::StrCat(loop, " has not ended after ", last->max_rounds, " rounds"));
  }
  return absl::OkStatus();
}

}  // namespace orbweave
