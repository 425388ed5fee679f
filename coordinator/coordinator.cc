// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/coordinator.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "absl/strings/str_cat.h"
#include "coordinator/durable_file.h"
#include "core/pipeline/build_version.h"

namespace orbweave {
namespace {

/// Waiting calls look at the clock this often: leases that ended and retries whose time has come.
constexpr std::chrono::milliseconds kLook{100};

/// Workers beat, and the journal is looked at, so often in a lease.
constexpr double kBeat = 0.1;

/// A journal that is another coordinator's is none that refuses a worker: the other takes its
/// result.
absl::Status ForWorkers(const absl::Status& saved) {
  return absl::IsFailedPrecondition(saved) ? absl::UnavailableError(saved.message()) : saved;
}

absl::Status CheckVersion(const WorkerInfo& worker) {
  if (worker.version == BuildVersion()) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrCat("worker ",
                                                    worker.name,
                                                    " is orbweave ",
                                                    worker.version,
                                                    ", the coordinator is ",
                                                    std::string(BuildVersion()),
                                                    ": install the same version on both"));
}

}  // namespace

absl::StatusOr<std::unique_ptr<Coordinator>> Coordinator::Open(const CoordinatorOptions& options,
                                                               const Clock& clock) {
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(options.state_dir));
  ORBWEAVE_ASSIGN_OR_RETURN(StateLock lock, StateLock::Acquire(options.state_dir));
  ORBWEAVE_ASSIGN_OR_RETURN(BlobStore blobs, BlobStore::Open(options.state_dir + "/blobs"));
  ORBWEAVE_ASSIGN_OR_RETURN(std::unique_ptr<Journal> journal,
                            options.open_journal(options.state_dir));
  std::unique_ptr<Coordinator> coordinator(
      new Coordinator(options, clock, std::move(lock), std::move(blobs), std::move(journal)));
  ORBWEAVE_RETURN_IF_ERROR(coordinator->desk_.Resume(options.leases_survive));
  coordinator->planner_.Start();
  coordinator->watch_.emplace(
      *coordinator->journal_,
      options.lease_s * kBeat,
      [raw = coordinator.get()](const absl::Status& why) { raw->JournalIsLost(why); });
  return coordinator;
}

Coordinator::Coordinator(const CoordinatorOptions& options,
                         const Clock& clock,
                         StateLock lock,
                         BlobStore blobs,
                         std::unique_ptr<Journal> journal)
    : options_(options),
      clock_(clock),
      lock_(std::move(lock)),
      blobs_(std::move(blobs)),
      journal_(std::move(journal)),
      dispatcher_({.lease_s = options.lease_s,
                   .retry = options.retry,
                   .log = options.log,
                   .changed = [this] { Wake(); }},
                  journal_->generation()),
      desk_(mutex_, dispatcher_, *journal_, options.find_plan, options.max_running_jobs, clock),
      planner_(mutex_, dispatcher_, desk_, blobs_, *journal_, clock) {}

Coordinator::~Coordinator() { BeginShutdown(); }

absl::StatusOr<JoinReply> Coordinator::Join(const WorkerInfo& worker) {
  ORBWEAVE_RETURN_IF_ERROR(CheckVersion(worker));
  const std::lock_guard lock(mutex_);
  ORBWEAVE_RETURN_IF_ERROR(CheckServing());
  return JoinReply{.session = dispatcher_.Join(worker, clock_.NowSeconds()),
                   .lease_s = options_.lease_s,
                   .heartbeat_s = options_.lease_s * kBeat};
}

absl::Status Coordinator::Leave(uint64_t session) {
  const std::lock_guard lock(mutex_);
  dispatcher_.Leave(session, clock_.NowSeconds());
  return absl::OkStatus();
}

absl::Status Coordinator::DrainWorker(const std::string& name) {
  const std::lock_guard lock(mutex_);
  ORBWEAVE_RETURN_IF_ERROR(dispatcher_.roster().Drain(name));
  dispatcher_.Log({.event = "worker_drained", .worker = name});
  WakeAll();
  return absl::OkStatus();
}

void Coordinator::WorkerDied(std::string_view name) {
  const std::lock_guard lock(mutex_);
  dispatcher_.WorkerDied(name, clock_.NowSeconds());
}

absl::StatusOr<std::optional<Lease>> Coordinator::LeaseTask(uint64_t session,
                                                            uint32_t slot,
                                                            double wait_s) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(wait_s);
  std::unique_lock lock(mutex_);
  while (true) {
    ORBWEAVE_RETURN_IF_ERROR(CheckServing());
    if (stopping_) return absl::UnavailableError("the coordinator is shutting down");
    const double now_s = clock_.NowSeconds();
    ORBWEAVE_RETURN_IF_ERROR(dispatcher_.roster().Hear(session, now_s));
    if (dispatcher_.roster().IsDraining(session))
      return absl::CancelledError("the worker is to leave");
    dispatcher_.ExpireLeases(now_s);
    if (const std::optional<Grant> grant = dispatcher_.GrantNext(session, slot, now_s)) {
      lock.unlock();
      return HandOut(session, *grant);
    }
    const auto now = std::chrono::steady_clock::now();
    if (now >= deadline) return std::nullopt;
    changed_.wait_for(lock, std::min<std::chrono::duration<double>>(kLook, deadline - now));
  }
}

absl::StatusOr<Lease> Coordinator::HandOut(uint64_t session, const Grant& grant) {
  const absl::Status saved = journal_->SaveStart(grant.attempt);
  if (saved.ok()) return grant.lease;
  const std::lock_guard lock(mutex_);
  dispatcher_.Log({.level = LogLevel::kError,
                   .event = "start_not_saved",
                   .job = grant.attempt.job,
                   .stage = grant.attempt.stage,
                   .part = grant.attempt.part,
                   .task = grant.attempt.task,
                   .worker = grant.attempt.worker,
                   .epoch = grant.attempt.epoch,
                   .message = std::string(saved.message())});
  dispatcher_
      .TaskFailed(session,
                  grant.lease,
                  absl::CancelledError(absl::StrCat("not handed out: ", saved.message())),
                  clock_.NowSeconds())
      .IgnoreError();  // the lease may have ended meanwhile
  return ForWorkers(saved);
}

absl::StatusOr<HeartbeatReply> Coordinator::Heartbeat(uint64_t session,
                                                      const std::vector<LeaseProgress>& leases) {
  const std::lock_guard lock(mutex_);
  ORBWEAVE_RETURN_IF_ERROR(CheckServing());
  ORBWEAVE_ASSIGN_OR_RETURN(HeartbeatReply reply,
                            dispatcher_.Heartbeat(session, leases, clock_.NowSeconds()));
  reply.shutdown = reply.shutdown || stopping_;
  return reply;
}

void Coordinator::LogOf(const Lease& lease,
                        LogLevel level,
                        const std::string& event,
                        const absl::Status& status) {
  dispatcher_.Log({.level = level,
                   .event = event,
                   .stage = lease.spec.stage,
                   .part = lease.spec.part,
                   .task = lease.task,
                   .epoch = lease.epoch,
                   .message = std::string(status.message())});
}

absl::Status Coordinator::CompleteTask(uint64_t session,
                                       const Lease& lease,
                                       const TaskResult& result) {
  for (const auto* blobs : {&result.outputs, &result.recipes}) {
    for (const Digest& blob : *blobs) {
      if (blobs_.Use(blob)) continue;
      return absl::InvalidArgumentError(absl::StrCat("the result of task ",
                                                     lease.task.ToShortHex(),
                                                     " names blob ",
                                                     blob.ToShortHex(),
                                                     ", never put"));
    }
  }
  std::unique_lock lock(mutex_);
  if (dispatcher_.jobs().WasDoneBy(lease)) return absl::OkStatus();
  ORBWEAVE_RETURN_IF_ERROR(dispatcher_.roster().Hear(session, clock_.NowSeconds()));
  const absl::Status held = dispatcher_.Hold(session, lease, clock_.NowSeconds());
  if (!held.ok()) {
    LogOf(lease, LogLevel::kWarning, "result_refused", held);
    return held;
  }
  lock.unlock();
  const absl::Status saved = journal_->SaveResult(lease.epoch, lease.task, result);
  lock.lock();
  if (saved.ok()) return dispatcher_.TaskDone(session, lease, result, clock_.NowSeconds());
  dispatcher_.LetGo(session, lease, clock_.NowSeconds());
  LogOf(lease, LogLevel::kError, "result_not_saved", saved);
  return ForWorkers(saved);
}

absl::Status Coordinator::FailTask(uint64_t session,
                                   const Lease& lease,
                                   const absl::Status& error) {
  if (error.ok()) return absl::InvalidArgumentError("a failure needs a reason");
  const std::lock_guard lock(mutex_);
  ORBWEAVE_RETURN_IF_ERROR(dispatcher_.roster().Hear(session, clock_.NowSeconds()));
  return dispatcher_.TaskFailed(session, lease, error, clock_.NowSeconds());
}

void Coordinator::JournalIsLost(const absl::Status& why) {
  {
    const std::lock_guard lock(mutex_);
    health_ = absl::AbortedError(why.message());
    dispatcher_.Log({.level = LogLevel::kError,
                     .event = "journal_lost",
                     .message = std::string(why.message())});
    WakeAll();
  }
  if (options_.lost) options_.lost();
}

absl::Status Coordinator::CheckServing() const {
  return health_.ok() ? absl::OkStatus() : absl::UnavailableError(health_.message());
}

absl::Status Coordinator::health() {
  const std::lock_guard lock(mutex_);
  return health_;
}

void Coordinator::BeginShutdown() {
  const std::lock_guard lock(mutex_);
  stopping_ = true;
  WakeAll();
}

void Coordinator::Wake() {
  if (dispatcher_.MayHaveWork()) changed_.notify_all();
  planner_.Wake();
}

void Coordinator::WakeAll() {
  changed_.notify_all();
  planner_.Wake();
}

}  // namespace orbweave
