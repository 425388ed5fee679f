// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/stage_context.h"
#include "core/pipeline/coordinator_api.h"
#include "core/pipeline/job_plan.h"
#include "core/pipeline/stage_function.h"

namespace orbweave {

/// Runs a whole job here and now, one task after the other, without coordinator, workers or
/// journal: all loops and parts of `plan`, to the same bytes as any number of workers. `job.inputs`
/// are in `blobs`, which gets all that stages leave; of the context the seed is not used. Returns
/// what is left of the last run of each stage, in (stage, part) order, as
/// CoordinatorApi::GetOutcomes does. Errors: those of PlanStage, the stages and `blobs`, which name
/// the stage; Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<std::vector<TaskOutcome>> RunPlan(const JobPlan& plan,
                                                               const JobSpec& job,
                                                               const StageLookup& stages,
                                                               BlobAccess& blobs,
                                                               const StageContext& context);

/// The same with the plan and the stages of this build. NotFound: there is no such kind of job.
[[nodiscard]] absl::StatusOr<std::vector<TaskOutcome>> RunJob(const JobSpec& job,
                                                              BlobAccess& blobs,
                                                              const StageContext& context);

}  // namespace orbweave
