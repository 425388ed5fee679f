// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <stop_token>

#include "core/pipeline/job_api.h"

namespace orbweave {

/// Told the status of a job about five times a second.
using JobListener = std::function<void(const JobStatus&)>;

/// Waits until a job is done, failed or cancelled and returns its last status, whichever it is.
/// Errors: what `check` returns when it is not OK (asked every time); Cancelled when `stop` came
/// first (the job goes on); those of GetJob.
[[nodiscard]] absl::StatusOr<JobStatus> WaitForJob(JobApi& coordinator,
                                                   const Digest& job,
                                                   const JobListener& listener,
                                                   const std::function<absl::Status()>& check,
                                                   const std::stop_token& stop);

}  // namespace orbweave
