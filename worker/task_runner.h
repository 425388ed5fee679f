// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/clock.h"
#include "core/pipeline/stage_function.h"

namespace orbweave {

/// Runs one task and measures it by what the whole process takes meanwhile. Codes of CallStage.
[[nodiscard]] absl::StatusOr<TaskResult> RunTask(const StageLookup& stages,
                                                 const TaskSpec& spec,
                                                 BlobAccess& blobs,
                                                 const StageContext& context,
                                                 const Clock& clock);

}  // namespace orbweave
