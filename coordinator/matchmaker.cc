// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/matchmaker.h"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace orbweave {
namespace {

/// The clock is looked at this often: leases that ended, retries whose time has come, stragglers
/// and waits that are over. By one thread, however many slots wait.
constexpr std::chrono::milliseconds kLook{100};

}  // namespace

void Matchmaker::Start() {
  thread_ = std::jthread([this](const std::stop_token& stop) { Run(stop); });
}

absl::StatusOr<std::optional<Grant>> Matchmaker::Await(std::unique_lock<std::mutex>& lock,
                                                       const TaskRequest& request) {
  const double now_s = clock_.NowSeconds();
  dispatcher_.ExpireLeases(now_s);
  std::optional<Grant> grant =
      dispatcher_.MayHaveWork(now_s)
          ? dispatcher_.GrantNext(
                request.session, request.slot, dispatcher_.roster().Serving(now_s), now_s)
          : std::nullopt;
  if (grant || request.until_s <= now_s) return grant;
  Waiting& waiting = waiting_.emplace_back();
  const auto place = std::prev(waiting_.end());
  waiting.request = request;
  waiting.answered.wait(lock, [&waiting] { return waiting.answer.has_value(); });
  Answer answer = *std::move(waiting.answer);
  waiting_.erase(place);
  return answer;
}

void Matchmaker::Wake() {
  is_woken_ = true;
  woken_.notify_one();
}

void Matchmaker::WakeAll() {
  looks_at_all_ = true;
  Wake();
}

void Matchmaker::Tell(Waiting& waiting, Answer answer) {
  waiting.answer = std::move(answer);
  waiting.answered.notify_one();
}

void Matchmaker::Run(const std::stop_token& stop) {
  using Steady = std::chrono::steady_clock;
  auto next_look = Steady::now();
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    woken_.wait_until(lock, stop, next_look, [this] { return is_woken_; });
    is_woken_ = false;
    const double now_s = clock_.NowSeconds();
    if (std::exchange(looks_at_all_, false) || Steady::now() >= next_look) {
      LookAtAll(now_s);
      next_look = Steady::now() + kLook;
    }
    GiveTasks(now_s);
  }
  LookAtAll(clock_.NowSeconds());  // who still waits is told of the end
}

void Matchmaker::LookAtAll(double now_s) {
  dispatcher_.ExpireLeases(now_s);
  for (Waiting& waiting : waiting_) {
    if (waiting.answer) continue;
    const absl::Status may_take = may_take_(waiting.request.session);
    if (!may_take.ok()) {
      Tell(waiting, may_take);
    } else if (waiting.request.left.stop_requested()) {
      Tell(waiting, absl::CancelledError("nobody waits for a task any more"));
    } else if (waiting.request.until_s <= now_s) {
      Tell(waiting, std::optional<Grant>());
    }
  }
}

void Matchmaker::GiveTasks(double now_s) {
  if (waiting_.empty() || !dispatcher_.MayHaveWork(now_s)) return;
  const std::vector<std::string> serving = dispatcher_.roster().Serving(now_s);
  for (const size_t leases : {0, 1}) {
    for (Waiting& waiting : waiting_) {
      const TaskRequest& request = waiting.request;
      const bool may_take = !waiting.answer && !request.left.stop_requested() &&
                            dispatcher_.CountAt(request.session, request.slot) == leases &&
                            may_take_(request.session).ok();
      if (!may_take) continue;
      std::optional<Grant> grant =
          dispatcher_.GrantNext(request.session, request.slot, serving, now_s);
      if (!grant) continue;
      Tell(waiting, std::move(grant));
      if (!dispatcher_.MayHaveWork(now_s)) return;
    }
  }
}

}  // namespace orbweave
