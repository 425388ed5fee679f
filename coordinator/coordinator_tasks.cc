// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Handing tasks out and taking what comes of them: nothing is given or acknowledged before it is
// saved.

#include <algorithm>
#include <cmath>
#include <future>
#include <memory>
#include <utility>

#include "absl/strings/str_cat.h"
#include "coordinator/coordinator.h"
#include "coordinator/job_limits.h"
#include "core/pipeline/is_to_leave.h"

namespace orbweave {
namespace {

/// Who asks for a task waits no longer: a call that nobody waits for any more, which is not
/// noticed, is over then.
constexpr double kLongestWait_s = 60.0;
/// All of them are looked at ten times a second.
constexpr size_t kMostWaiting = 50'000;

}  // namespace

absl::Status Coordinator::CheckTaker(uint64_t session) {
  ORBWEAVE_RETURN_IF_ERROR(CheckServing());
  if (stopping_) return absl::UnavailableError("the coordinator is shutting down");
  ORBWEAVE_RETURN_IF_ERROR(dispatcher_.roster().Check(session));
  if (!dispatcher_.roster().IsDraining(session)) return absl::OkStatus();
  return absl::CancelledError(kIsToLeave);
}

absl::Status Coordinator::HearAsker(uint64_t session, uint32_t slot) {
  ORBWEAVE_RETURN_IF_ERROR(CheckTaker(session));
  ORBWEAVE_RETURN_IF_ERROR(dispatcher_.roster().CheckSlot(session, slot));
  // Once: that a call is still here says nothing about who made it.
  return dispatcher_.roster().Hear(session, clock_.NowSeconds());
}

void Coordinator::AskForTask(
    uint64_t session, uint32_t slot, double wait_s, const std::stop_token& left, TakeLease take) {
  if (!std::isfinite(wait_s) || wait_s < 0.0) {
    return take(absl::InvalidArgumentError("who asks for a task waits for a number of seconds"));
  }
  std::unique_lock lock(mutex_);
  if (const absl::Status may_ask = HearAsker(session, slot); !may_ask.ok()) {
    lock.unlock();
    return take(may_ask);
  }
  if (matchmaker_.num_waiting() >= kMostWaiting) {
    lock.unlock();
    return take(absl::UnavailableError("too many calls wait for a task"));
  }
  const double until_s = clock_.NowSeconds() + std::min(wait_s, kLongestWait_s);
  matchmaker_.Ask(std::move(lock), {session, slot, until_s, left}, std::move(take));
}

absl::StatusOr<std::optional<Lease>> Coordinator::LeaseTask(uint64_t session,
                                                            uint32_t slot,
                                                            double wait_s,
                                                            const std::stop_token& left) {
  using Answer = absl::StatusOr<std::optional<Lease>>;
  const auto answer = std::make_shared<std::promise<Answer>>();
  AskForTask(
      session, slot, wait_s, left, [answer](Answer lease) { answer->set_value(std::move(lease)); });
  return answer->get_future().get();
}

absl::StatusOr<HeartbeatReply> Coordinator::Heartbeat(uint64_t session,
                                                      const std::vector<LeaseProgress>& leases) {
  const std::lock_guard lock(mutex_);
  ORBWEAVE_RETURN_IF_ERROR(CheckServing());
  ORBWEAVE_ASSIGN_OR_RETURN(HeartbeatReply reply,
                            dispatcher_.Heartbeat(session, leases, clock_.NowSeconds()));
  reply.shutdown = reply.shutdown || dismisses_;
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
  ORBWEAVE_RETURN_IF_ERROR(CheckSizeOf(result));
  for (const auto* blobs : {&result.outputs, &result.recipes}) {
    for (const Digest& blob : *blobs) {
      const absl::StatusOr<bool> is_stored = blobs_.Confirm(blob);
      // What ails the store is no fault of the result.
      if (!is_stored.ok()) return absl::UnavailableError(is_stored.status().message());
      if (*is_stored) continue;
      return absl::AbortedError(absl::StrCat("the result of task ",
                                             lease.task.ToShortHex(),
                                             " names blob ",
                                             blob.ToShortHex(),
                                             ", which is not in the store"));
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
  return dispatcher_.TaskFailed(session, lease, Shortened(error), clock_.NowSeconds());
}

}  // namespace orbweave
