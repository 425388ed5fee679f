// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "core/pipeline/task.h"

namespace orbweave {

struct JobSpec {
  std::string kind{};            ///< names a JobPlan
  std::vector<Digest> inputs{};  ///< blobs put before the job is submitted
  std::string options_text{};
  std::string label{};  ///< for people
  /// The span that asked for it, as W3C Trace Context writes it; empty: none. Where the job's own
  /// spans are told, it is their parent.
  std::string traceparent{};

  /// Digest of kind, inputs and options: submitting the same job again joins it.
  [[nodiscard]] Digest Id() const;
};

enum class JobState : uint8_t { kRunning, kDone, kFailed, kCancelled };

/// "running", "done", "failed" or "cancelled".
[[nodiscard]] std::string_view JobStateName(JobState state);

/// What is known of a stage of a job.
struct StageStatus {
  std::string stage{};
  uint32_t tasks_total = 0;  ///< 0 until it is planned
  uint32_t tasks_done = 0;
  uint32_t tasks_reused = 0;  ///< of tasks_done: found finished, not computed again
  uint32_t tasks_running = 0;
  uint32_t retries = 0;
  double wall_s = 0.0;          ///< first lease to last result; of a loop, summed over its rounds
  double cpu_s = 0.0;           ///< sum over tasks computed now
  double fraction_running = 0;  ///< progress of running tasks, in tasks
  double weight = 1.0;          ///< StageRule::weight
  double usual_runs = 1.0;      ///< StageRule::usual_runs
  uint32_t runs = 0;            ///< so far: a loop's stage runs several times
  double busy_s = 0.0;          ///< sum over tasks computed now of the time each took
  bool has_parts = false;       ///< as many tasks as another stage decides
};

/// One finished attempt, for the trace.
struct TaskTiming {
  uint32_t run = 0;  ///< as in MeasuredTask
  std::string stage{};
  uint32_t part = 0;
  std::string worker{};
  uint32_t slot = 0;
  double start_s = 0.0;  ///< since the job was submitted: leased, and the slot's task before ended
  double end_s = 0.0;
  bool ok = true;
};

struct TaskOutcome {
  std::string stage{};
  uint32_t part = 0;
  Digest id{};
  TaskResult result{};
};

struct WorkerStatus {
  std::string name{};
  uint32_t slots = 1;
  uint32_t tasks_done = 0;
  bool alive = true;
  bool set_aside = false;      ///< it failed tasks that others then did, and gets no more
  bool draining = false;       ///< it finishes what it has
  uint32_t tasks_running = 0;  ///< in so many slots
};

struct JobStatus {
  Digest id{};
  JobState state = JobState::kRunning;
  std::string error{};  ///< of a failed job: names stage, task and reason
  /// Of a running job: what its tasks ask for and no worker that is alive ever has; empty: nothing.
  std::string unmet{};
  JobSpec spec{};
  double elapsed_s = 0.0;
  uint32_t slots = 0;  ///< of all workers that are given tasks
  std::vector<StageStatus> stages{};
};

/// Jobs of a coordinator: how they come in, how they are, and what came of them. Every method is
/// safe to call from several threads and safe to repeat. Codes common to all: Unavailable
/// (connection; try again).
class JobApi {
 public:
  virtual ~JobApi() = default;
  /// Starts (or joins, or resumes) a job. InvalidArgument: unknown kind, or a
  /// description too long. NotFound: an input blob is
  /// missing. ResourceExhausted: too many jobs are running.
  [[nodiscard]] virtual absl::StatusOr<Digest> SubmitJob(const JobSpec& job) = 0;
  /// NotFound: no such job.
  [[nodiscard]] virtual absl::StatusOr<JobStatus> GetJob(const Digest& job) = 0;
  [[nodiscard]] virtual absl::StatusOr<std::vector<JobStatus>> ListJobs() = 0;
  /// Who works for the coordinator, and who did until a while ago, by name.
  [[nodiscard]] virtual absl::StatusOr<std::vector<WorkerStatus>> ListWorkers() = 0;
  /// How many slots of workers there is work for, now or in the last minute: for who starts
  /// workers.
  [[nodiscard]] virtual absl::StatusOr<uint32_t> CountWantedSlots() = 0;
  [[nodiscard]] virtual absl::Status CancelJob(const Digest& job) = 0;
  /// Takes a job that has ended off the list: nothing is kept for it any more (see CollectGarbage).
  /// FailedPrecondition: it runs.
  [[nodiscard]] virtual absl::Status ForgetJob(const Digest& job) = 0;
  /// Results of a job's finished tasks in (stage, part) order, of a loop those of its last round,
  /// and timings in order of their end.
  [[nodiscard]] virtual absl::StatusOr<std::vector<TaskOutcome>> GetOutcomes(const Digest& job) = 0;
  [[nodiscard]] virtual absl::StatusOr<std::vector<TaskTiming>> GetTimings(const Digest& job) = 0;
  /// All finished tasks of a job in (run, part) order, every round of its loops among them.
  [[nodiscard]] virtual absl::StatusOr<std::vector<MeasuredTask>> GetCosts(const Digest& job) = 0;
};

}  // namespace orbweave
