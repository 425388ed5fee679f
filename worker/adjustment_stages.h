// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/pipeline/blob_access.h"
#include "core/pipeline/task.h"
#include "worker/kept_blocks.h"

/// The global adjustment in blocks. Inputs as in core/pipeline/job_plan.cc.

namespace orbweave {

/// One round: leaves where all worlds stand; a recipe per block that has work. Worlds smaller than
/// blocks.distribute_from are adjusted here and now, by the same steps.
absl::StatusOr<TaskResult> RunSteerAdjustment(const TaskSpec& spec,
                                              BlobAccess& blobs,
                                              const StageContext& context);

/// Leaves the answer, then what blobs it names. The block stays in `kept`.
absl::StatusOr<TaskResult> RunAdjustBlock(const TaskSpec& spec,
                                          BlobAccess& blobs,
                                          const StageContext& context,
                                          KeptBlocks& kept);

/// Leaves the model but for its tracks.
absl::StatusOr<TaskResult> RunConcludeAdjustment(const TaskSpec& spec,
                                                 BlobAccess& blobs,
                                                 const StageContext& context);

}  // namespace orbweave
