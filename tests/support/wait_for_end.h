// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pipeline/job_api.h"
#include "tests/support/command.h"

namespace orbweave::testing {

/// Waits for a job's end; its last status.
inline absl::StatusOr<JobStatus> WaitForEnd(JobApi& api, const Digest& job) {
  constexpr double kLimit_s = 20.0;
  absl::StatusOr<JobStatus> status;
  (void)WaitUntil(
      [&] {
        status = api.GetJob(job);
        return !status.ok() || status->state != JobState::kRunning;
      },
      kLimit_s);
  return status;
}

}  // namespace orbweave::testing
