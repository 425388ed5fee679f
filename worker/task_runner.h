// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/clock.h"
#include "worker/stage_table.h"

namespace orbweave {

/// Where a worker finds its stages: FindStage, or a table of a test's own. nullptr: no such stage.
using StageLookup = std::function<const StageFunction*(std::string_view stage)>;

/// Whose processor time a task is charged with.
enum class CpuClock : uint8_t {
  kThread,   ///< of the calling thread: several tasks share the process
  kProcess,  ///< of the whole process: it runs one task at a time, on as many threads as it likes
};

/// Runs one task and measures it. Exceptions of third-party libraries and std::bad_alloc end here
/// and nowhere else: ResourceExhausted when memory ran out, Internal with the exception's text
/// otherwise. Unimplemented when there is no such stage.
[[nodiscard]] absl::StatusOr<TaskResult> RunTask(const StageLookup& stages,
                                                 const TaskSpec& spec,
                                                 BlobAccess& blobs,
                                                 const StageContext& context,
                                                 const Clock& clock,
                                                 CpuClock cpu_clock);

}  // namespace orbweave
