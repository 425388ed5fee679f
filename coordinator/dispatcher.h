// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "coordinator/job_table.h"
#include "coordinator/jobs/lease_book.h"
#include "coordinator/journal/journal.h"
#include "coordinator/worker_roster.h"
#include "core/pipeline/log_event.h"

namespace orbweave {

struct DispatcherOptions {
  double lease_s = 20.0;  ///< a worker silent for so long loses its tasks
  RetryPolicy retry{};
  EventLog log{};
  std::function<void()> changed{};  ///< called when there may be something new to do
};

/// A task given to a worker: what the worker gets, and what the journal keeps.
struct Grant {
  Lease lease{};
  Attempt attempt{};
};

/// What is to be written down, though nobody waits for it.
struct LooseEnds {
  std::vector<AttemptEnd> attempts{};
  std::vector<WorkerBlame> blames{};
  std::vector<Digest> spoilt{};  ///< tasks whose results are to be forgotten
};

/// What a coordinator knows: jobs, who works on which task until when, and which attempts ended
/// since that was last saved. Pure bookkeeping: time is handed in, nothing is read or written. Not
/// thread-safe.
class Dispatcher {
 public:
  /// `generation`: the high half of the epochs and sessions given out.
  Dispatcher(DispatcherOptions options, uint64_t generation);

  [[nodiscard]] JobTable& jobs() { return jobs_; }
  [[nodiscard]] WorkerRoster& roster() { return roster_; }
  /// Lets a job begin (anew): what was leased of it before is void.
  Job& BeginJob(const JobSpec& spec, JobPlan plan, uint64_t number, double now_s);
  void CancelJob(const Digest& id, double now_s);
  /// Counts what failed before a restart of the coordinator against the budgets of a job that has
  /// just begun.
  void CountFailures(const Digest& id, std::vector<FailedAttempt> failures);
  /// Takes a job that has ended out of the table.
  void ForgetJob(const Digest& id);

  /// Begins a session. The worker goes on with the leases it lists; others it had are void.
  [[nodiscard]] uint64_t Join(const WorkerInfo& worker, double now_s);
  void Leave(uint64_t session, double now_s);
  void WorkerDied(std::string_view name, double now_s);
  /// Of all workers that are given tasks.
  [[nodiscard]] uint32_t SlotsAtWork(double now_s) const { return roster_.SlotsAtWork(now_s); }
  /// Of every worker that the roster has, by name.
  [[nodiscard]] std::vector<WorkerStatus> WorkerStatuses(double now_s) const;

  /// What a job's ready tasks ask for and no worker that is there ever has, in words that name the
  /// stage; empty: nothing.
  [[nodiscard]] std::string UnmetOf(const Job& job, double now_s) const;
  /// Whether there may be a task to grant, ever; quick.
  [[nodiscard]] bool MayHaveWork() const;
  /// Whether there may be one now: a task is ready, or a straggler may be done once more.
  [[nodiscard]] bool MayHaveWork(double now_s) const;
  /// How many leases a slot holds.
  [[nodiscard]] size_t CountAt(uint64_t session, uint32_t slot) const;
  /// A slot that holds a lease may get one more, ahead; see ChoosePart. `serving`: those of the
  /// roster now. The lease has no end, and an end of its attempt is no loose end, until it begins.
  [[nodiscard]] std::optional<Grant> GrantNext(uint64_t session,
                                               uint32_t slot,
                                               const std::vector<std::string>& serving,
                                               double now_s);
  /// A lease that was granted is written down, or could not be: its time runs from now on. False:
  /// it ended before.
  bool Begin(uint64_t session, const Lease& lease, double now_s);
  /// A lease of an earlier generation, whose holder has one lease time to come back.
  void Await(const Attempt& attempt, double now_s);
  /// See WorkerApi::Heartbeat.
  [[nodiscard]] absl::StatusOr<HeartbeatReply> Heartbeat(uint64_t session,
                                                         const std::vector<LeaseProgress>& leases,
                                                         double now_s);
  /// Keeps a lease from ending while its result is saved. FailedPrecondition: it ended before.
  [[nodiscard]] absl::Status Hold(uint64_t session, const Lease& lease, double now_s);
  /// The result of a lease that was held could not be saved: it may be handed in again.
  void LetGo(uint64_t session, const Lease& lease, double now_s);
  /// The result of a lease that was held is saved. FailedPrecondition: the job went on without.
  [[nodiscard]] absl::Status TaskDone(uint64_t session,
                                      const Lease& lease,
                                      const TaskResult& result,
                                      double now_s);
  [[nodiscard]] absl::Status TaskFailed(uint64_t session,
                                        const Lease& lease,
                                        const absl::Status& error,
                                        double now_s);
  void ExpireLeases(double now_s);

  /// The stage that was prepared begins; tasks whose leases were awaited go on under them. A job
  /// that had ended before the coordinator was started, and whose results are not all found, fails:
  /// nobody asked for it anew.
  void StageBegins(const Digest& id, PreparedStage prepared, double now_s);
  void JobFails(const Digest& id, const std::string& error, double now_s);
  /// How many results came of awaited leases before their stage was planned: a stage prepared
  /// before the last of them may have missed it.
  [[nodiscard]] uint64_t early_results() const { return early_results_; }

  [[nodiscard]] bool HasLooseEnds() const;
  /// Without attempts whose start is not written down yet: their end would not find it.
  [[nodiscard]] LooseEnds TakeLooseEnds();
  /// The epoch that was given out last.
  [[nodiscard]] uint64_t last_epoch() const { return last_epoch_; }
  void Log(const LogEvent& event) const;

 private:
  struct JobTask {
    Digest job{};
    TaskRef task{};
  };
  /// What a worker is to do next in this slot, which holds so many leases: what is ready in the
  /// oldest job, or else a straggler.
  [[nodiscard]] std::optional<JobTask> NextTask(const WorkerSlot& at,
                                                const std::vector<std::string>& serving,
                                                double now_s);
  /// Whether a task as they usually are ends before the worker leaves.
  [[nodiscard]] bool HasTime(const WorkerSlot& at, const JobMachine& machine, double now_s) const;
  /// What the tasks take that a worker runs in its other slots.
  [[nodiscard]] StageNeeds TakenBeside(const WorkerSlot& at) const;
  /// A worker handed in a result: what that says of it, and of those who failed before.
  void CountDone(uint64_t session, const LeaseEntry& entry, const TaskResult& result);
  void EndAttempt(const LeaseEntry& entry, const absl::Status& error, double now_s);
  /// Its worker is lost. A task that only waited there has not been tried.
  void EndLost(const LeaseEntry& entry, const absl::Status& error, double now_s);
  void EndAllLost(const std::vector<LeaseEntry>& entries, const std::string& reason, double now_s);
  /// What the book knows of an attempt, to be logged as `event`.
  [[nodiscard]] LogEvent Describe(const LeaseEntry& entry, const std::string& event);
  /// An attempt ends that nobody waits for any more.
  void EndVoid(const LeaseEntry& entry, const std::string& reason);
  void VoidLeases(const Digest& job, const std::string& reason);
  void FailOrBeginAnew(const LeaseEntry& entry, const absl::Status& error, double now_s);
  /// A blob cannot be read: the job begins anew, and with it the tasks that left it, better
  /// elsewhere.
  void MakeAgain(const LeaseEntry& reader,
                 const Digest& blob,
                 const absl::Status& error,
                 double now_s);
  void NoteDamage(TaskRef maker, const LeaseEntry& reader, const std::string& reason);
  void BeginAnew(Job& job, double now_s);

  DispatcherOptions options_;
  JobTable jobs_;
  LeaseBook book_;
  WorkerRoster roster_;
  std::set<uint64_t> starting_;  ///< epochs that were granted and not written down yet
  std::vector<AttemptEnd> ends_;
  std::vector<Digest> spoilt_;  ///< see LooseEnds
  uint64_t last_epoch_;
  uint64_t last_session_;
  uint64_t early_results_ = 0;
};

}  // namespace orbweave
