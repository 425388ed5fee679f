// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/stage_context.h"
#include "core/pipeline/blob_access.h"
#include "core/pipeline/task.h"

namespace orbweave {

struct JobSpec {
  std::string kind{};            ///< names a JobPlan
  std::vector<Digest> inputs{};  ///< blobs put before the job is submitted
  std::string options_text{};
  std::string label{};  ///< for people

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
  bool set_aside = false;  ///< it failed tasks that others then did, and gets no more
  bool draining = false;   ///< it finishes what it has
  uint32_t tasks_running = 0;  ///< in so many slots
};

struct JobStatus {
  Digest id{};
  JobState state = JobState::kRunning;
  std::string error{};  ///< of a failed job: names stage, task and reason
  JobSpec spec{};
  double elapsed_s = 0.0;
  std::vector<StageStatus> stages{};
  std::vector<WorkerStatus> workers{};
};

/// A lease that a worker holds, and how far its task is.
struct LeaseProgress {
  Digest task{};
  uint64_t epoch = 0;
  Progress progress{};
};

struct WorkerInfo {
  std::string name{};     ///< unique among workers
  std::string version{};  ///< build version; another one than the coordinator's is refused
  uint32_t slots = 1;
  std::vector<LeaseProgress> held{};  ///< leases of its last session that it goes on with
  uint64_t process = 0;  ///< a random number that names its process; 0: another one every time
};

struct JoinReply {
  uint64_t session = 0;
  double lease_s = 30.0;
  double heartbeat_s = 5.0;
};

struct Lease {
  Digest task{};
  uint64_t epoch = 0;  ///< fencing: a result under an older epoch is refused
  TaskSpec spec{};
  uint32_t slot = 0;
};

struct HeartbeatReply {
  std::vector<Digest> cancelled{};  ///< leases to give up
  bool shutdown = false;            ///< finish nothing more; leave
};

/// Which blobs are garbage: no job names them, and nobody used them for a while.
struct GarbageOptions {
  /// What was put, asked for or found within this time stays: results that are not handed in yet,
  /// inputs of a job that is being submitted. Longer than any task and any upload.
  double unused_s = 86'400.0;
  bool dry_run = false;  ///< removes nothing
};

/// What a collection of garbage found. Files that are only linked count as blobs without bytes.
struct GarbageReport {
  uint64_t needed_blobs = 0;  ///< jobs name them
  uint64_t needed_bytes = 0;
  uint64_t recent_blobs = 0;  ///< nobody names them, but they were used
  uint64_t recent_bytes = 0;
  uint64_t removed_blobs = 0;  ///< or, in a dry run, would be
  uint64_t removed_bytes = 0;
  uint64_t forgotten_results = 0;  ///< of no job, and without their blobs; none in a dry run
};

/// The one seam of distribution: in-process it is the coordinator object, elsewhere a gRPC stub.
/// Every method is safe to call from several threads and safe to repeat. Codes common to all:
/// Unavailable (connection; try again).
class CoordinatorApi : public BlobAccess {
 public:
  /// FailedPrecondition: another version. A known name begins a new session; the worker goes on
  /// with the leases it lists (the next heartbeat tells which are not its own any more), and its
  /// others are void.
  [[nodiscard]] virtual absl::StatusOr<JoinReply> Join(const WorkerInfo& worker) = 0;
  /// A task to do, or nullopt when none became ready within wait_s. NotFound: unknown session (join
  /// again). Cancelled: the worker is to finish what it has, and to leave.
  [[nodiscard]] virtual absl::StatusOr<std::optional<Lease>> LeaseTask(uint64_t session,
                                                                       uint32_t slot,
                                                                       double wait_s) = 0;
  /// Renews the leases listed. NotFound: unknown session.
  [[nodiscard]] virtual absl::StatusOr<HeartbeatReply> Heartbeat(
      uint64_t session, const std::vector<LeaseProgress>& leases) = 0;
  /// FailedPrecondition: stale epoch, the result was not taken (harmless). NotFound: unknown
  /// session (join again).
  [[nodiscard]] virtual absl::Status CompleteTask(uint64_t session,
                                                  const Lease& lease,
                                                  const TaskResult& result) = 0;
  /// The error's code decides what becomes of the task (coordinator/retry_policy.cc has the table):
  /// InvalidArgument and its like are permanent and fail the job; Cancelled gives the task back;
  /// others are tried again, so often. Answers as CompleteTask.
  [[nodiscard]] virtual absl::Status FailTask(uint64_t session,
                                              const Lease& lease,
                                              const absl::Status& error) = 0;
  [[nodiscard]] virtual absl::Status Leave(uint64_t session) = 0;

  /// Gives a worker no more tasks: it finishes what it has and leaves. It may join anew. NotFound:
  /// no such worker is there.
  [[nodiscard]] virtual absl::Status DrainWorker(const std::string& name) = 0;

  /// Starts (or joins, or resumes) a job. InvalidArgument: unknown kind. NotFound: an input blob is
  /// missing. ResourceExhausted: too many jobs are running.
  [[nodiscard]] virtual absl::StatusOr<Digest> SubmitJob(const JobSpec& job) = 0;
  /// NotFound: no such job.
  [[nodiscard]] virtual absl::StatusOr<JobStatus> GetJob(const Digest& job) = 0;
  [[nodiscard]] virtual absl::StatusOr<std::vector<JobStatus>> ListJobs() = 0;
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

  /// Which of these blobs are stored (same order).
  [[nodiscard]] virtual absl::StatusOr<std::vector<bool>> StatBlobs(
      const std::vector<Digest>& digests) = 0;
  /// Registers a file on the coordinator's machine as a blob without copying it; verified at every
  /// read. NotFound / PermissionDenied: the coordinator cannot read it; DataLoss: it has another
  /// digest.
  [[nodiscard]] virtual absl::Status LinkFile(const Digest& digest, const std::string& path) = 0;
  /// Removes blobs that no job on the list needs: to run, to go on after it failed or was
  /// cancelled, or to show its results. May end at any moment, and be repeated. FailedPrecondition:
  /// what a job needs cannot be told; nothing was removed. InvalidArgument: no number of seconds.
  [[nodiscard]] virtual absl::StatusOr<GarbageReport> CollectGarbage(
      const GarbageOptions& options) = 0;
};

}  // namespace orbweave
