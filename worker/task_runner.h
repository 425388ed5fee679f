// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/clock.h"
#include "worker/stage_table.h"

namespace orbweave {

/// Where a worker finds its stages: FindStage, or a table of a test's own. nullptr: no such stage.
using StageLookup = std::function<const StageFunction*(std::string_view stage)>;

/// Runs one task and measures it by what the whole process takes meanwhile. Exceptions of
/// third-party libraries and std::bad_alloc end here and nowhere else: ResourceExhausted when
/// memory ran out, Internal with the exception's text otherwise. Unimplemented when there is no
/// such stage.
[[nodiscard]] absl::StatusOr<TaskResult> RunTask(const StageLookup& stages,
                                                 const TaskSpec& spec,
                                                 BlobAccess& blobs,
                                                 const StageContext& context,
                                                 const Clock& clock);

}  // namespace orbweave
