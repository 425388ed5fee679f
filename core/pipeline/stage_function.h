// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string_view>

#include "absl/status/statusor.h"
#include "core/base/stage_context.h"
#include "core/pipeline/blob_access.h"
#include "core/pipeline/task.h"

namespace orbweave {

/// Does one task: reads its inputs, computes, stores what it leaves.
using StageFunction = std::function<absl::StatusOr<TaskResult>(
    const TaskSpec& spec, BlobAccess& blobs, const StageContext& context)>;

/// Where whoever runs tasks finds their stages. nullptr: there is no such stage.
using StageLookup = std::function<const StageFunction*(std::string_view stage)>;

/// Does one task. Exceptions of third-party libraries and std::bad_alloc end here and nowhere else:
/// ResourceExhausted when memory ran out, Internal with the exception's text otherwise.
/// Unimplemented when there is no such stage.
[[nodiscard]] absl::StatusOr<TaskResult> CallStage(const StageLookup& stages,
                                                   const TaskSpec& spec,
                                                   BlobAccess& blobs,
                                                   const StageContext& context);

}  // namespace orbweave
