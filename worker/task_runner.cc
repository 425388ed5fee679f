// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/task_runner.h"

#include <ctime>
#include <exception>
#include <new>
#include <string>

#include "absl/strings/str_cat.h"
#include "worker/metered_blobs.h"
#include "worker/peak_memory.h"

namespace orbweave {
namespace {

double CpuSeconds() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

absl::StatusOr<TaskResult> CallStage(const StageFunction& stage,
                                     const TaskSpec& spec,
                                     BlobAccess& blobs,
                                     const StageContext& context) {
  try {
    return stage(spec, blobs, context);
  } catch (const std::bad_alloc&) {
    return absl::ResourceExhaustedError("out of memory");
  } catch (const std::exception& error) {
    return absl::InternalError(error.what());
  }
}

}  // namespace

absl::StatusOr<TaskResult> RunTask(const StageLookup& stages,
                                   const TaskSpec& spec,
                                   BlobAccess& blobs,
                                   const StageContext& context,
                                   const Clock& clock) {
  const StageFunction* stage = stages(spec.stage);
  if (stage == nullptr)
    return absl::UnimplementedError(absl::StrCat("this build has no stage ", spec.stage));
  MeteredBlobs counted(blobs);
  RestartPeakMemory();
  const double start_s = clock.NowSeconds();
  const double cpu_start_s = CpuSeconds();
  ORBWEAVE_ASSIGN_OR_RETURN(TaskResult result, CallStage(*stage, spec, counted, context));
  result.cost = {.wall_s = clock.NowSeconds() - start_s,
                 .cpu_s = CpuSeconds() - cpu_start_s,
                 .bytes_in = counted.bytes_in(),
                 .bytes_out = counted.bytes_out(),
                 .peak_memory_bytes = PeakMemoryBytes()};
  return result;
}

}  // namespace orbweave
