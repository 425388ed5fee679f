// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/task_runner.h"

#include <ctime>

#include "worker/metered_blobs.h"
#include "worker/peak_memory.h"

namespace orbweave {
namespace {

double CpuSeconds() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

absl::StatusOr<TaskResult> RunTask(const StageLookup& stages,
                                   const TaskSpec& spec,
                                   BlobAccess& blobs,
                                   const StageContext& context,
                                   const Clock& clock) {
  MeteredBlobs counted(blobs);
  RestartPeakMemory();
  const double start_s = clock.NowSeconds();
  const double cpu_start_s = CpuSeconds();
  ORBWEAVE_ASSIGN_OR_RETURN(TaskResult result, CallStage(stages, spec, counted, context));
  result.cost = {.wall_s = clock.NowSeconds() - start_s,
                 .cpu_s = CpuSeconds() - cpu_start_s,
                 .bytes_in = counted.bytes_in(),
                 .bytes_out = counted.bytes_out(),
                 .peak_memory_bytes = PeakMemoryBytes()};
  return result;
}

}  // namespace orbweave
