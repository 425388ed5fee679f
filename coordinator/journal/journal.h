// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/pipeline/job_api.h"

namespace orbweave {

/// A job as it is remembered across restarts.
struct JobEntry {
  JobSpec spec{};
  JobState state = JobState::kRunning;
  std::string error{};
  uint64_t number = 0;       ///< order of submission
  uint64_t since_epoch = 0;  ///< later attempts count against its budgets
};

/// One attempt at a task: a lease, as it is remembered across restarts.
struct Attempt {
  uint64_t epoch = 0;  ///< names it
  Digest task{};
  Digest job{};
  std::string stage{};
  uint32_t part = 0;
  std::string worker{};
  uint32_t slot = 0;
};

/// An attempt that ended without a result, and why.
struct AttemptEnd {
  uint64_t epoch = 0;
  std::string reason{};
  absl::StatusCode code = absl::StatusCode::kCancelled;  ///< given back: nobody failed
};

/// What an attempt that failed counts for.
struct FailedAttempt {
  Digest task{};
  std::string worker{};
  absl::StatusCode code = absl::StatusCode::kUnknown;
  std::string reason{};
};

/// Tasks that the process of a worker failed and others then did, since it did one itself.
struct WorkerBlame {
  std::string worker{};
  uint64_t process = 0;
  uint32_t blames = 0;
};

/// What became of an attempt. The times are seconds since 1970 by the clock of the coordinator's
/// machine, for people only.
struct AttemptRecord {
  Attempt attempt{};
  double started_s = 0.0;
  std::optional<double> ended_s{};
  std::string reason{};  ///< empty when it ended with a result
};

/// Whether the result of a task may be forgotten.
using IsGarbage = std::function<bool(const Digest& task, const TaskResult& result)>;

/// What the coordinator must not forget: jobs, attempts, results, and how often it was started.
/// Whatever a call has saved is durable when it returns OK, and saving it again changes nothing.
/// One coordinator has a journal at a time. Thread-safe.
///
/// Errors of every call: Unavailable (try again later), ResourceExhausted (disk full), DataLoss
/// (the store is damaged; says what to do), FailedPrecondition (another coordinator has taken the
/// journal over).
class Journal {
 public:
  virtual ~Journal() = default;

  /// 1, 2, 3, ...: how often this journal was opened. The high half of every epoch and session.
  [[nodiscard]] virtual uint64_t generation() const = 0;
  /// Whether saving would be allowed: OK, or one of the errors.
  [[nodiscard]] virtual absl::Status Confirm() = 0;
  /// Whether saving is possible: saves something that means nothing and takes no more room each
  /// time.
  [[nodiscard]] virtual absl::Status TrySave() = 0;

  [[nodiscard]] virtual absl::Status SaveJob(const JobEntry& job) = 0;
  /// In order of submission.
  [[nodiscard]] virtual absl::StatusOr<std::vector<JobEntry>> LoadJobs() = 0;
  /// Forgets a job and the attempts made for it. Results stay: other jobs may have them too.
  [[nodiscard]] virtual absl::Status ForgetJob(const Digest& job) = 0;

  /// Tasks are handed out.
  [[nodiscard]] virtual absl::Status SaveStarts(const std::vector<Attempt>& attempts) = 0;
  [[nodiscard]] absl::Status SaveStart(const Attempt& attempt) { return SaveStarts({attempt}); }
  /// Attempt `epoch` ends with the result of `task`.
  [[nodiscard]] virtual absl::Status SaveResult(uint64_t epoch,
                                                const Digest& task,
                                                const TaskResult& result) = 0;
  [[nodiscard]] virtual absl::Status SaveEnds(const std::vector<AttemptEnd>& ends) = 0;

  /// One answer per task: nothing where none was saved, or what was saved is damaged.
  [[nodiscard]] virtual absl::StatusOr<std::vector<std::optional<TaskResult>>> LoadResults(
      const std::vector<Digest>& tasks) = 0;
  /// Forgets the result of a task, if there is one.
  [[nodiscard]] virtual absl::Status ForgetResultOf(const Digest& task) = 0;
  /// Forgets results; how many. `is_garbage` is asked about each, and again, while nothing is
  /// saved, about those that are to go. It does not call the journal.
  [[nodiscard]] virtual absl::StatusOr<uint64_t> ForgetResults(const IsGarbage& is_garbage) = 0;
  /// Attempts that started and did not end, in order of epoch.
  [[nodiscard]] virtual absl::StatusOr<std::vector<Attempt>> LoadOpenAttempts() = 0;
  /// Attempts for a job after `since_epoch` that failed and were not just given back, in order of
  /// epoch.
  [[nodiscard]] virtual absl::StatusOr<std::vector<FailedAttempt>> LoadFailures(
      const Digest& job, uint64_t since_epoch) = 0;
  /// All attempts at a task, in order of epoch.
  [[nodiscard]] virtual absl::StatusOr<std::vector<AttemptRecord>> LoadAttempts(
      const Digest& task) = 0;

  /// The last of each worker counts.
  [[nodiscard]] virtual absl::Status SaveBlames(const std::vector<WorkerBlame>& blames) = 0;
  /// By name; without those that nothing is to be blamed for.
  [[nodiscard]] virtual absl::StatusOr<std::vector<WorkerBlame>> LoadBlames() = 0;
};

}  // namespace orbweave
