// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>

#include "core/base/digest.h"
#include "core/base/status.h"
#include "core/pipeline/job_plan.h"
#include "core/pipeline/task.h"

namespace orbweave {

/// Sees to it that the loops of a job end, whatever its tasks leave: a round is one of at most
/// StageRule::max_rounds, and never the same as one before, since equal tasks leave equal results
/// and all that follows would come again for ever.
class LoopGuard {
 public:
  /// Stage number `stage` is about to have these tasks. FailedPrecondition, with the stage's name
  /// and the round: they are those of an earlier round, or of one too many. OK for stages that no
  /// loop begins with.
  [[nodiscard]] absl::Status Enter(const JobPlan& plan,
                                   uint32_t stage,
                                   std::span<const TaskSpec> tasks);

 private:
  std::map<uint32_t, std::set<Digest>> rounds_{};  ///< of each stage that a loop begins with
};

}  // namespace orbweave
