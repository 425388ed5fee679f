// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string_view>

#include "core/base/stage_context.h"
#include "core/pipeline/blob_access.h"
#include "core/pipeline/task.h"

namespace orbweave {

/// Runs one task: fetches its inputs, calls the pure stage, stores what it returns.
using StageFunction = std::function<absl::StatusOr<TaskResult>(
    const TaskSpec& spec, BlobAccess& blobs, const StageContext& context)>;

/// The stage of this name, or nullptr. The table of contents of what a worker can do.
[[nodiscard]] const StageFunction* FindStage(std::string_view stage);

}  // namespace orbweave
