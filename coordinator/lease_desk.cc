// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/lease_desk.h"

#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {

absl::Status ForWorkers(const absl::Status& saved) {
  return absl::IsFailedPrecondition(saved) ? absl::UnavailableError(saved.message()) : saved;
}

void LeaseDesk::Start() {
  writer_ = std::jthread([this](const std::stop_token& stop) {
    Serve(granted_, stop, [this](const auto& granted) { HandOut(granted); });
  });
  teller_ = std::jthread([this](const std::stop_token& stop) { Serve(others_, stop, Tell); });
}

void LeaseDesk::End() {
  writer_ = {};
  teller_ = {};
}

void LeaseDesk::Settle(TaskAnswer answer) {
  Queue& queue = answer.grant.ok() && *answer.grant ? granted_ : others_;
  const std::lock_guard lock(queue.mutex);
  queue.answers.push_back(std::move(answer));
  queue.changed.notify_one();
}

void LeaseDesk::Serve(Queue& queue, const std::stop_token& stop, const Round& round) {
  while (true) {
    std::unique_lock lock(queue.mutex);
    queue.changed.wait(lock, stop, [&queue] { return !queue.answers.empty(); });
    if (queue.answers.empty()) return;
    const std::vector<TaskAnswer> answers = std::exchange(queue.answers, {});
    lock.unlock();
    round(answers);
  }
}

void LeaseDesk::Tell(const std::vector<TaskAnswer>& answers) {
  for (const TaskAnswer& answer : answers) {
    answer.call->take(answer.grant.ok() ? absl::StatusOr<std::optional<Lease>>(std::nullopt)
                                        : answer.grant.status());
  }
}

void LeaseDesk::HandOut(const std::vector<TaskAnswer>& granted) {
  std::vector<Attempt> attempts;
  for (const TaskAnswer& answer : granted) attempts.push_back((*answer.grant)->attempt);
  const absl::Status saved = journal_.SaveStarts(attempts);
  std::vector<absl::StatusOr<std::optional<Lease>>> leases;
  {
    const std::lock_guard lock(mutex_);
    for (const TaskAnswer& answer : granted)
      leases.push_back(Conclude(answer.call->request, **answer.grant, saved));
  }
  for (size_t i = 0; i < granted.size(); ++i) granted[i].call->take(std::move(leases[i]));
}

absl::StatusOr<std::optional<Lease>> LeaseDesk::Conclude(const TaskRequest& request,
                                                         const Grant& grant,
                                                         const absl::Status& saved) {
  const bool goes_on = dispatcher_.Begin(request.session, grant.lease, clock_.NowSeconds());
  if (!saved.ok()) {
    dispatcher_.Log({.level = LogLevel::kError,
                     .event = "start_not_saved",
                     .job = grant.attempt.job,
                     .stage = grant.attempt.stage,
                     .part = grant.attempt.part,
                     .task = grant.attempt.task,
                     .worker = grant.attempt.worker,
                     .epoch = grant.attempt.epoch,
                     .message = std::string(saved.message())});
    TakeBack(request.session, grant, absl::StrCat("not handed out: ", saved.message()));
    return ForWorkers(saved);
  }
  if (!goes_on) return std::nullopt;
  if (!request.left.stop_requested()) return grant.lease;
  TakeBack(request.session, grant, "nobody waits for it any more");
  return absl::CancelledError("nobody waits for a task any more");
}

void LeaseDesk::TakeBack(uint64_t session, const Grant& grant, const std::string& reason) {
  dispatcher_.TaskFailed(session, grant.lease, absl::CancelledError(reason), clock_.NowSeconds())
      .IgnoreError();  // the lease may have ended meanwhile
}

}  // namespace orbweave
