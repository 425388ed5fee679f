// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/coordinator.h"

#include <utility>

#include "coordinator/check_worker.h"
#include "core/storage/durable_file.h"

namespace orbweave {
namespace {

/// Workers beat, and the journal is looked at, so often in a lease.
constexpr double kBeat = 0.1;

}  // namespace

absl::StatusOr<std::unique_ptr<Coordinator>> Coordinator::Open(const CoordinatorOptions& options,
                                                               const Clock& clock) {
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(options.state_dir));
  ORBWEAVE_ASSIGN_OR_RETURN(StateLock lock, StateLock::Acquire(options.state_dir));
  ORBWEAVE_ASSIGN_OR_RETURN(
      KeptBlobs blobs,
      KeptBlobs::Open(
          options.state_dir, options.objects, options.object_roots, options.object_limits));
  ORBWEAVE_ASSIGN_OR_RETURN(std::unique_ptr<Journal> journal,
                            options.open_journal(options.state_dir));
  std::unique_ptr<Coordinator> coordinator(
      new Coordinator(options, clock, std::move(lock), std::move(blobs), std::move(journal)));
  ORBWEAVE_RETURN_IF_ERROR(coordinator->job_service_.Resume(options.leases_survive));
  coordinator->planner_.Start();
  coordinator->desk_.Start();
  coordinator->matchmaker_.Start();
  coordinator->watch_.emplace(
      *coordinator->journal_,
      options.lease_s * kBeat,
      [raw = coordinator.get()](const absl::Status& why) { raw->JournalIsLost(why); });
  return coordinator;
}

Coordinator::Coordinator(const CoordinatorOptions& options,
                         const Clock& clock,
                         StateLock lock,
                         KeptBlobs blobs,
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
      wanted_(options.max_slots),
      job_service_(
          mutex_, dispatcher_, *journal_, options.find_plan, options.max_running_jobs, clock),
      desk_(mutex_, dispatcher_, *journal_, clock),
      matchmaker_(
          mutex_,
          dispatcher_,
          clock,
          [this](uint64_t session) { return CheckTaker(session); },
          [this](TaskAnswer answer) { desk_.Settle(std::move(answer)); }),
      planner_(mutex_, dispatcher_, wanted_, job_service_, blobs_, *journal_, clock) {}

Coordinator::~Coordinator() {
  BeginShutdown(Farewell::kComeBack);
  matchmaker_.End();
  desk_.End();
}

absl::StatusOr<JoinReply> Coordinator::Join(const WorkerInfo& worker) {
  ORBWEAVE_RETURN_IF_ERROR(CheckWorker(worker));
  const std::lock_guard lock(mutex_);
  ORBWEAVE_RETURN_IF_ERROR(CheckServing());
  matchmaker_.WakeAll();  // the session before is over
  return JoinReply{.session = dispatcher_.Join(worker, clock_.NowSeconds()),
                   .lease_s = options_.lease_s,
                   .heartbeat_s = options_.lease_s * kBeat};
}

absl::Status Coordinator::Leave(uint64_t session) {
  const std::lock_guard lock(mutex_);
  dispatcher_.Leave(session, clock_.NowSeconds());
  return absl::OkStatus();
}

absl::StatusOr<std::vector<std::string>> Coordinator::DrainWorkers(const std::string& name) {
  const std::lock_guard lock(mutex_);
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<std::string> drained, dispatcher_.roster().Drain(name));
  for (const std::string& worker : drained)
    dispatcher_.Log({.event = "worker_drained", .worker = worker});
  WakeAll();
  return drained;
}

absl::Status Coordinator::StopCoordinator() {
  if (!options_.stop)
    return absl::FailedPreconditionError("this coordinator ends with its job, or by Ctrl-C");
  {
    const std::lock_guard lock(mutex_);
    dispatcher_.Log({.event = "coordinator_told_to_stop"});
  }
  options_.stop();
  return absl::OkStatus();
}

void Coordinator::WorkerDied(std::string_view name) {
  const std::lock_guard lock(mutex_);
  dispatcher_.WorkerDied(name, clock_.NowSeconds());
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

void Coordinator::BeginShutdown(Farewell farewell) {
  const std::lock_guard lock(mutex_);
  stopping_ = true;
  dismisses_ = dismisses_ || farewell == Farewell::kDismissWorkers;
  WakeAll();
}

void Coordinator::Wake() {
  if (dispatcher_.MayHaveWork()) matchmaker_.Wake();
  planner_.Wake();
}

void Coordinator::WakeAll() {
  matchmaker_.WakeAll();
  planner_.Wake();
}

}  // namespace orbweave
