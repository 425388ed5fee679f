// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/fleet/wait_for_job.h"

#include "core/base/sleep.h"
#include "core/base/status.h"

namespace orbweave {

absl::StatusOr<JobStatus> WaitForJob(JobApi& coordinator,
                                     const Digest& job,
                                     const JobListener& listener,
                                     const std::function<absl::Status()>& check,
                                     const std::stop_token& stop) {
  constexpr double kPause_s = 0.2;
  while (!stop.stop_requested()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus status, coordinator.GetJob(job));
    if (listener) listener(status);
    if (status.state != JobState::kRunning) return status;
    if (check) ORBWEAVE_RETURN_IF_ERROR(check());
    SleepUnlessStopped(kPause_s, stop);
  }
  return absl::CancelledError(
      "interrupted; what is finished is kept, the same command goes on from here");
}

}  // namespace orbweave
