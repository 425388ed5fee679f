// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>

#include "coordinator/dispatcher.h"
#include "coordinator/job_service.h"
#include "coordinator/journal/journal.h"
#include "coordinator/journal/journal_watch.h"
#include "coordinator/journal/open_journal.h"
#include "coordinator/kept_blobs.h"
#include "coordinator/lease_desk.h"
#include "coordinator/matchmaker.h"
#include "coordinator/planner.h"
#include "coordinator/served_api.h"
#include "coordinator/state_lock.h"
#include "coordinator/wanted_slots.h"
#include "core/base/clock.h"
#include "core/pipeline/log_event.h"

namespace orbweave {

inline constexpr double kDefaultLease_s = 20.0;

struct CoordinatorOptions {
  std::string state_dir{};
  /// Whether workers outlive the process of the coordinator. Then what they held when it died is
  /// given to others only when they did not come back within one lease time.
  bool leases_survive = true;
  /// A worker silent for so long loses its tasks; it beats ten times as often.
  double lease_s = kDefaultLease_s;
  uint32_t max_running_jobs = 1000;                           ///< more are not taken
  uint32_t max_slots = std::numeric_limits<uint32_t>::max();  ///< more are never wanted
  RetryPolicy retry{};
  PlanLookup find_plan = FindNoPlan;
  std::function<absl::StatusOr<std::unique_ptr<Journal>>(const std::string& state_dir)>
      open_journal = OpenJournal;
  std::shared_ptr<ObjectStore> objects{};  ///< for large blobs; null: all stay in its folder
  ObjectRoots object_roots{};              ///< beneath which clients may name objects
  ObjectLimits object_limits{};            ///< of the object store
  EventLog log{};
  std::function<void()> lost{};  ///< called when health() is OK no more
  std::function<void()> stop{};  ///< called when an administrator wants it to end
};

/// What a coordinator that shuts down tells its workers.
enum class Farewell {
  kDismissWorkers,  ///< to end
  kComeBack,        ///< nothing: it, or another on its state, will be there again
};

/// The coordinator: gives tasks to workers that ask, takes each result once, and remembers jobs,
/// leases and results. A lease is durable before it is handed out, a result before it is
/// acknowledged. Opened again on the same state it goes on where it was: a task whose result and
/// blobs are there is not computed again. Thread-safe; see CoordinatorApi and its parts for
/// the contract of each call.
class Coordinator final : public ServedApi {
 public:
  /// FailedPrecondition: the state is in use by another coordinator, or of another version.
  /// DataLoss: it is damaged. `clock` outlives the coordinator.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<Coordinator>> Open(
      const CoordinatorOptions& options, const Clock& clock);
  ~Coordinator() override;

  [[nodiscard]] absl::StatusOr<std::string> Get(const Digest& digest) override;
  [[nodiscard]] absl::StatusOr<Digest> Put(std::string_view bytes) override;
  [[nodiscard]] absl::Status Read(const Digest& digest, const TakePiece& take) override;
  [[nodiscard]] absl::Status Write(const Digest& digest,
                                   uint64_t size_bytes,
                                   const NextPiece& next) override;

  [[nodiscard]] absl::StatusOr<JoinReply> Join(const WorkerInfo& worker) override;
  using WorkerApi::LeaseTask;
  [[nodiscard]] absl::StatusOr<std::optional<Lease>> LeaseTask(
      uint64_t session, uint32_t slot, double wait_s, const std::stop_token& left) override;
  void AskForTask(uint64_t session,
                  uint32_t slot,
                  double wait_s,
                  const std::stop_token& left,
                  TakeLease take) override;
  [[nodiscard]] absl::StatusOr<HeartbeatReply> Heartbeat(
      uint64_t session, const std::vector<LeaseProgress>& leases) override;
  [[nodiscard]] absl::Status CompleteTask(uint64_t session,
                                          const Lease& lease,
                                          const TaskResult& result) override;
  [[nodiscard]] absl::Status FailTask(uint64_t session,
                                      const Lease& lease,
                                      const absl::Status& error) override;
  [[nodiscard]] absl::Status Leave(uint64_t session) override;
  [[nodiscard]] absl::StatusOr<std::vector<std::string>> DrainWorkers(
      const std::string& name) override;
  [[nodiscard]] absl::Status StopCoordinator() override;

  [[nodiscard]] absl::StatusOr<Digest> SubmitJob(const JobSpec& job) override;
  [[nodiscard]] absl::StatusOr<JobStatus> GetJob(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<JobStatus>> ListJobs() override;
  [[nodiscard]] absl::StatusOr<std::vector<WorkerStatus>> ListWorkers() override;
  [[nodiscard]] absl::StatusOr<uint32_t> CountWantedSlots() override { return SlotsWanted(); }
  [[nodiscard]] absl::Status CancelJob(const Digest& job) override;
  [[nodiscard]] absl::Status ForgetJob(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<TaskOutcome>> GetOutcomes(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<TaskTiming>> GetTimings(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<MeasuredTask>> GetCosts(const Digest& job) override;

  [[nodiscard]] absl::StatusOr<std::vector<bool>> StatBlobs(
      const std::vector<Digest>& digests) override;
  [[nodiscard]] absl::Status LinkFile(const Digest& digest, const std::string& path) override;
  [[nodiscard]] absl::StatusOr<std::vector<BlobGrant>> GrantBlobs(
      const std::vector<WantedBlob>& blobs, GrantVerb verb) override;
  [[nodiscard]] absl::Status FinishUpload(const UploadEnd& end) override;
  [[nodiscard]] absl::StatusOr<GarbageReport> CollectGarbage(
      const GarbageOptions& options) override;

  /// Somebody saw the process of this worker end: its leases are void at once.
  void WorkerDied(std::string_view name);
  /// Of workers and clients, since the start.
  [[nodiscard]] BlobTraffic blob_traffic() const { return {bytes_in_, bytes_out_}; }
  /// Aborted once another coordinator has taken the journal over. Then this one gives and takes
  /// nothing any more: to workers and clients it is Unavailable, so that they look for the other.
  [[nodiscard]] absl::Status health();
  /// OK while its threads move: one that waits for the journal or for blobs does, for to start the
  /// coordinator again would not help it. Unavailable: which has not moved for a lease time. Takes
  /// no lock.
  [[nodiscard]] absl::Status CheckLive() const;
  /// OK when it can work: the journal saves and is its own, a blob can be put and got. Waits for
  /// both.
  [[nodiscard]] absl::Status CheckReady();
  /// How many slots of workers there is work for; see wanted_slots.h.
  [[nodiscard]] uint32_t SlotsWanted();
  /// Wakes every waiting call and gives no more tasks.
  void BeginShutdown(Farewell farewell = Farewell::kDismissWorkers);

 private:
  Coordinator(const CoordinatorOptions& options,
              const Clock& clock,
              StateLock lock,
              KeptBlobs blobs,
              std::unique_ptr<Journal> journal);
  /// What `look` says of a job, with the lock. NotFound: there is no such job.
  template <typename Look>
  [[nodiscard]] auto LookAt(const Digest& job, Look&& look)
      -> absl::StatusOr<decltype(look(std::declval<const Job&>()))>;
  /// With the lock.
  [[nodiscard]] JobStatus StatusOf(const Job& job, double now_s) const;
  void JournalIsLost(const absl::Status& why);
  /// With the lock: health(), to workers.
  [[nodiscard]] absl::Status CheckServing() const;
  /// With the lock: whether a worker may be given tasks.
  [[nodiscard]] absl::Status CheckTaker(uint64_t session);
  /// With the lock: the same of one that asks for this slot, and notes that it was heard.
  [[nodiscard]] absl::Status HearAsker(uint64_t session, uint32_t slot);
  /// With the lock: logs what became of a lease's result.
  void LogOf(const Lease& lease,
             LogLevel level,
             const std::string& event,
             const absl::Status& status);
  /// There may be something new to do: wakes the planner, and who waits for a task if there is one.
  void Wake();
  void WakeAll();

  CoordinatorOptions options_;
  const Clock& clock_;
  StateLock lock_;
  KeptBlobs blobs_;
  std::unique_ptr<Journal> journal_;
  std::atomic<uint64_t> bytes_in_{0};
  std::atomic<uint64_t> bytes_out_{0};

  std::mutex collecting_mutex_;  ///< one collection of garbage at a time; taken before all others
  std::mutex mutex_;
  Dispatcher dispatcher_;
  WantedSlots wanted_;
  bool stopping_ = false;
  bool dismisses_ = false;
  absl::Status health_;
  JobService job_service_;
  LeaseDesk desk_;
  Matchmaker matchmaker_;
  Planner planner_;
  std::optional<JournalWatch> watch_;  ///< last: ends before what it uses
};

}  // namespace orbweave
