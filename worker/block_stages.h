// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/pipeline/blob_access.h"
#include "core/pipeline/task.h"

/// From submodels to the blocks of the global adjustment. Inputs as in core/pipeline/job_plan.cc.

namespace orbweave {

/// Leaves the worlds; a recipe per block.
absl::StatusOr<TaskResult> RunJoinSubmodels(const TaskSpec& spec,
                                            BlobAccess& blobs,
                                            const StageContext& context);

/// Leaves the block.
absl::StatusOr<TaskResult> RunAssembleBlock(const TaskSpec& spec,
                                            BlobAccess& blobs,
                                            const StageContext& context);

}  // namespace orbweave
