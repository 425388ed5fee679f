// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/coordinator.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/pipeline/build_version.h"
#include "core/storage/durable_file.h"

namespace orbweave {
namespace {

/// Workers beat, and the journal is looked at, so often in a lease.
constexpr double kBeat = 0.1;

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

std::string BlobFolderOf(const std::string& state_dir) { return state_dir + "/blobs"; }

absl::StatusOr<std::unique_ptr<Coordinator>> Coordinator::Open(const CoordinatorOptions& options,
                                                               const Clock& clock) {
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(options.state_dir));
  ORBWEAVE_ASSIGN_OR_RETURN(StateLock lock, StateLock::Acquire(options.state_dir));
  ORBWEAVE_ASSIGN_OR_RETURN(BlobStore blobs, BlobStore::Open(BlobFolderOf(options.state_dir)));
  ORBWEAVE_ASSIGN_OR_RETURN(std::unique_ptr<Journal> journal,
                            options.open_journal(options.state_dir));
  std::unique_ptr<Coordinator> coordinator(
      new Coordinator(options, clock, std::move(lock), std::move(blobs), std::move(journal)));
  ORBWEAVE_RETURN_IF_ERROR(coordinator->job_service_.Resume(options.leases_survive));
  coordinator->planner_.Start();
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
      job_service_(
          mutex_, dispatcher_, *journal_, options.find_plan, options.max_running_jobs, clock),
      planner_(mutex_, dispatcher_, job_service_, blobs_, *journal_, clock),
      matchmaker_(
          mutex_, dispatcher_, clock, [this](uint64_t session) { return CheckTaker(session); }) {}

Coordinator::~Coordinator() { BeginShutdown(Farewell::kComeBack); }

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
