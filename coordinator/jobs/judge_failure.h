// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "coordinator/jobs/retry_policy.h"
#include "coordinator/jobs/task_record.h"

namespace orbweave {

/// How much of a job failed.
struct JobTally {
  uint32_t failures = 0;  ///< of attempts
  size_t tasks = 0;
  bool another_may_try = false;  ///< a worker that has not failed the task
};

/// An attempt at `task` failed on `worker`, which is counted already: why the job fails now, or
/// nothing when the task is tried again.
[[nodiscard]] std::optional<std::string> JudgeFailure(const RetryPolicy& policy,
                                                      const TaskRecord& task,
                                                      const std::string& worker,
                                                      const absl::Status& error,
                                                      const JobTally& job);

}  // namespace orbweave
