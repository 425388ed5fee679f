// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "coordinator/blob_store.h"
#include "coordinator/job_machine.h"
#include "coordinator/journal.h"
#include "coordinator/lease_book.h"
#include "coordinator/prepare_stage.h"
#include "coordinator/state_lock.h"
#include "coordinator/worker_roster.h"
#include "core/base/clock.h"
#include "core/pipeline/coordinator_api.h"

namespace orbweave {

struct CoordinatorOptions {
  std::string state_dir{};
  double lease_s =
      20.0;  ///< a worker silent for so long loses its tasks; it beats ten times as often
  RetryPolicy retry{};
  std::function<absl::StatusOr<JobPlan>(std::string_view kind)> find_plan = FindJobPlan;
  /// Told one line per event ("task failed stage=... part=... worker=..."); may be empty. Must be
  /// quick.
  std::function<void(const std::string& line)> log{};
};

/// The coordinator: gives tasks to workers that ask, takes each result once, and remembers both
/// results and jobs in `state_dir`. Opened again on the same folder it goes on where it was: a task
/// whose result and blobs are there is not computed again. Thread-safe; see CoordinatorApi for the
/// contract of each call.
class Coordinator final : public CoordinatorApi {
 public:
  /// FailedPrecondition: the folder is in use by another coordinator. `clock` outlives the
  /// coordinator.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<Coordinator>> Open(
      const CoordinatorOptions& options, const Clock& clock);
  ~Coordinator() override;

  [[nodiscard]] absl::StatusOr<std::string> Get(const Digest& digest) override;
  [[nodiscard]] absl::StatusOr<Digest> Put(std::string_view bytes) override;

  [[nodiscard]] absl::StatusOr<JoinReply> Join(const WorkerInfo& worker) override;
  [[nodiscard]] absl::StatusOr<std::optional<Lease>> LeaseTask(uint64_t session,
                                                               uint32_t slot,
                                                               double wait_s) override;
  [[nodiscard]] absl::StatusOr<HeartbeatReply> Heartbeat(
      uint64_t session, const std::vector<LeaseProgress>& leases) override;
  [[nodiscard]] absl::Status CompleteTask(uint64_t session,
                                          const Lease& lease,
                                          const TaskResult& result) override;
  [[nodiscard]] absl::Status FailTask(uint64_t session,
                                      const Lease& lease,
                                      const absl::Status& error) override;
  [[nodiscard]] absl::Status Leave(uint64_t session) override;
  [[nodiscard]] absl::Status DrainWorker(const std::string& name) override;

  [[nodiscard]] absl::StatusOr<Digest> SubmitJob(const JobSpec& job) override;
  [[nodiscard]] absl::StatusOr<JobStatus> GetJob(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<JobStatus>> ListJobs() override;
  [[nodiscard]] absl::Status CancelJob(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<TaskOutcome>> GetOutcomes(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<TaskTiming>> GetTimings(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<MeasuredTask>> GetCosts(const Digest& job) override;

  [[nodiscard]] absl::StatusOr<std::vector<bool>> StatBlobs(
      const std::vector<Digest>& digests) override;
  [[nodiscard]] absl::Status LinkFile(const Digest& digest, const std::string& path) override;

  /// Somebody saw the process of this worker end: its leases are void at once.
  void WorkerDied(std::string_view name);
  /// Wakes every waiting call, gives no more tasks and tells workers to leave.
  void BeginShutdown();

 private:
  struct Job {
    uint64_t number = 0;
    uint64_t run =
        0;  ///< which run of the job the machine is: results prepared for another are dropped
    bool verify = true;
    bool saved = true;  ///< its end is on disk
    uint32_t reruns = 0;
    std::unique_ptr<JobMachine> machine{};
  };
  struct JobTask {
    Digest job{};
    TaskRef task{};
  };

  Coordinator(const CoordinatorOptions& options,
              const Clock& clock,
              StateLock lock,
              BlobStore blobs,
              Journal journal);
  [[nodiscard]] absl::Status ResumeJobs();

  // All of these with mutex_ held.
  [[nodiscard]] Job* FindJob(const Digest& id);
  void StartRun(Job& job, const JobSpec& spec, JobPlan plan);
  /// What `worker` is to do now: what is ready in the oldest job, or else a straggler.
  [[nodiscard]] std::optional<JobTask> NextTask(const std::string& worker, double now_s) const;
  [[nodiscard]] std::optional<Lease> GrantNext(uint64_t session, uint32_t slot);
  [[nodiscard]] bool WasDoneBy(const Lease& lease) const;
  void EndAttempt(const LeaseEntry& entry, const absl::Status& error);
  void EndAttempts(const std::vector<LeaseEntry>& entries, const std::string& reason);
  void ExpireLeases();
  void WakeAll();
  void Log(const std::string& line) const;
  [[nodiscard]] std::optional<Digest> JobToPlan() const;
  [[nodiscard]] std::optional<Digest> JobToSave() const;

  // The planner thread.
  void RunPlanner(std::stop_token stop);
  void PlanNextStage(const Digest& id);
  void SaveEnd(const Digest& id);

  CoordinatorOptions options_;
  const Clock& clock_;
  StateLock lock_;
  BlobStore blobs_;
  Journal journal_;

  std::mutex saving_mutex_;  ///< one writer of job files at a time; taken before mutex_
  std::mutex mutex_;
  std::condition_variable_any changed_;  ///< a task may be ready, or the end is near
  std::condition_variable_any to_plan_;
  std::map<Digest, Job> jobs_;
  std::map<uint64_t, Digest> order_;  ///< jobs by number: the oldest is served first
  LeaseBook book_;
  WorkerRoster roster_;
  uint64_t last_epoch_;
  uint64_t last_session_;
  uint64_t last_run_ = 0;
  bool stopping_ = false;
  std::jthread planner_;  ///< last: ends before what it uses
};

}  // namespace orbweave
