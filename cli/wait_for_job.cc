// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/wait_for_job.h"

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace orbweave {
namespace {

void Pause(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  never.wait_for(lock, stop, std::chrono::milliseconds(200), [] { return false; });
}

}  // namespace

absl::StatusOr<JobStatus> WaitForJob(CoordinatorApi& coordinator,
                                     const Digest& job,
                                     const JobListener& listener,
                                     const std::function<absl::Status()>& check,
                                     const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus status, coordinator.GetJob(job));
    if (listener) listener(status);
    if (status.state != JobState::kRunning) return status;
    if (check) ORBWEAVE_RETURN_IF_ERROR(check());
    Pause(stop);
  }
  return absl::CancelledError(
      "interrupted; what is finished is kept, the same command goes on from here");
}

}  // namespace orbweave
