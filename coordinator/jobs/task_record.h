// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "coordinator/jobs/retry_policy.h"
#include "core/base/stage_context.h"
#include "core/pipeline/job_api.h"

namespace orbweave {

/// Where a task is worked on: each slot of a worker has a process of its own.
struct WorkerSlot {
  std::string worker{};
  uint32_t slot = 0;
  friend auto operator<=>(const WorkerSlot&, const WorkerSlot&) = default;
};

/// Who works on a task, for the record.
struct TaskHolder {
  uint64_t epoch = 0;
  std::string worker{};
  uint32_t slot = 0;
};

/// A task that somebody works on.
struct RunningAttempt {
  TaskHolder holder{};
  double leased_s = 0.0;
  Progress progress{};
};

/// One task of a job and what came of it so far.
struct TaskRecord {
  TaskSpec spec{};
  Digest id{};
  bool done = false;
  bool is_repeated = false;                ///< found, as an earlier round of a loop has it too
  TaskHolder done_by{};                    ///< whose result was taken; nobody when it was found
  std::vector<RunningAttempt> attempts{};  ///< that go on now: one, or two of a straggler
  double not_before_s = 0.0;
  FailureCounts failures{};
  std::vector<std::string> failed_on{};  ///< workers
  TaskCost cost{};

  [[nodiscard]] bool HasFailedOn(const std::string& worker) const;
  /// Whether `worker` may begin an attempt: the wait is over, and it has not failed the task, or
  /// all workers in `alive` have.
  [[nodiscard]] bool MayTake(const std::string& worker,
                             const std::vector<std::string>& alive,
                             double now_s) const;
  /// The attempt under this epoch; nullptr: there is none.
  [[nodiscard]] RunningAttempt* FindAttempt(uint64_t epoch);
  /// Of the attempt that has come furthest.
  [[nodiscard]] double Fraction() const;
  /// "stage s, part 3 (task 1f2e3d4c)".
  [[nodiscard]] std::string Describe() const;
  /// The digests of what it reads; the first few of many.
  [[nodiscard]] std::string DescribeInputs() const;
};

}  // namespace orbweave
