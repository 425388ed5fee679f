// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Handing tasks out and taking what comes of them: nothing is given or acknowledged before it is
// saved.

#include <algorithm>
#include <chrono>

#include "absl/strings/str_cat.h"
#include "coordinator/coordinator.h"

namespace orbweave {
namespace {

/// Waiting calls look at the clock this often: leases that ended and retries whose time has come.
constexpr std::chrono::milliseconds kLook{100};

/// A journal that is another coordinator's is none that refuses a worker: the other takes its
/// result.
absl::Status ForWorkers(const absl::Status& saved) {
  return absl::IsFailedPrecondition(saved) ? absl::UnavailableError(saved.message()) : saved;
}

}  // namespace

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

}  // namespace orbweave
