// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/pipeline/blob_access.h"
#include "core/pipeline/job_api.h"
#include "core/pipeline/job_plan.h"
#include "core/pipeline/task.h"

namespace orbweave {

/// The tasks of one stage, and the collection blobs they read, which are stored before they start.
struct StagePlan {
  std::vector<TaskSpec> tasks{};
  std::vector<std::string> collections{};
};

/// Writes down the tasks of stage number `stage` of `plan`. `results[s][p]` is what part p of stage
/// s left behind when it last ran; `listed_recipes` is the decoded collection that the stage's
/// `parts_listed_in` names (empty otherwise). InvalidArgument: the job has too few inputs.
/// FailedPrecondition: a stage before left fewer outputs than the plan asks for, or the plan states
/// no version of the stage. Pure: equal arguments give equal tasks.
[[nodiscard]] absl::StatusOr<StagePlan> PlanStage(
    const JobPlan& plan,
    uint32_t stage,
    const JobSpec& job,
    const std::vector<std::vector<TaskResult>>& results,
    const std::vector<Digest>& listed_recipes);

/// The recipes that the stage's `parts_listed_in` names; none where it has no such list.
/// InvalidArgument: the job has no such input. Errors of `blobs`.
[[nodiscard]] absl::StatusOr<std::vector<Digest>> ReadListedRecipes(const JobPlan& plan,
                                                                    uint32_t stage,
                                                                    const JobSpec& job,
                                                                    BlobAccess& blobs);

}  // namespace orbweave
