// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/matchmaker.h"

#include <chrono>
#include <string>
#include <vector>

namespace orbweave {
namespace {

/// The clock is looked at this often: leases that ended, retries whose time has come, stragglers
/// and waits that are over. By one thread, however many slots wait.
constexpr std::chrono::milliseconds kLook{100};

absl::Status NobodyWaits() { return absl::CancelledError("nobody waits for a task any more"); }

}  // namespace

void Matchmaker::Start() {
  pulse_.Beat(clock_.NowSeconds());
  thread_ = std::jthread([this](const std::stop_token& stop) { Run(stop); });
}

void Matchmaker::End() { thread_ = {}; }

void Matchmaker::Ask(std::unique_lock<std::mutex> lock, TaskRequest request, TakeLease take) {
  const auto call = std::make_shared<TaskCall>();
  call->request = std::move(request);
  call->take = std::move(take);
  const TaskRequest& asked = call->request;
  const double now_s = clock_.NowSeconds();
  dispatcher_.ExpireLeases(now_s);
  if (const auto before = places_.find(PlaceOf(asked)); before != places_.end())
    SettleAt(before->second, absl::AbortedError("it was asked again for this slot"));
  std::optional<Grant> grant =
      dispatcher_.MayHaveWork(now_s)
          ? dispatcher_.GrantNext(
                asked.session, asked.slot, dispatcher_.roster().Serving(now_s), now_s)
          : std::nullopt;
  if (grant || asked.until_s <= now_s) return settle_({call, std::move(grant)});
  places_[PlaceOf(asked)] = waiting_.insert(waiting_.end(), call);
  lock.unlock();
  call->on_left.emplace(asked.left, [this, raw = call.get()] { Leave(*raw); });
}

void Matchmaker::Wake() {
  is_woken_ = true;
  woken_.notify_one();
}

void Matchmaker::WakeAll() {
  looks_at_all_ = true;
  Wake();
}

void Matchmaker::Leave(const TaskCall& call) {
  const std::lock_guard lock(mutex_);
  const auto place = places_.find(PlaceOf(call.request));
  if (place != places_.end() && place->second->get() == &call)
    SettleAt(place->second, NobodyWaits());
}

Matchmaker::Waiting::iterator Matchmaker::SettleAt(Waiting::iterator it,
                                                   absl::StatusOr<std::optional<Grant>> grant) {
  TaskAnswer answer{std::move(*it), std::move(grant)};
  places_.erase(PlaceOf(answer.call->request));
  settle_(std::move(answer));
  return waiting_.erase(it);
}

void Matchmaker::Run(const std::stop_token& stop) {
  using Steady = std::chrono::steady_clock;
  auto next_look = Steady::now();
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    woken_.wait_until(lock, stop, next_look, [this] { return is_woken_; });
    is_woken_ = false;
    const double now_s = clock_.NowSeconds();
    pulse_.Beat(now_s);
    if (std::exchange(looks_at_all_, false) || Steady::now() >= next_look) {
      LookAtAll(now_s);
      next_look = Steady::now() + kLook;
    }
    GiveTasks(now_s);
  }
  LookAtAll(clock_.NowSeconds());  // who still waits is told of the end
  pulse_.Rest();
}

void Matchmaker::LookAtAll(double now_s) {
  dispatcher_.ExpireLeases(now_s);
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    const TaskRequest& request = (*it)->request;
    const absl::Status may_take = may_take_(request.session);
    if (!may_take.ok()) {
      it = SettleAt(it, may_take);
    } else if (request.left.stop_requested()) {
      it = SettleAt(it, NobodyWaits());
    } else if (request.until_s <= now_s) {
      it = SettleAt(it, std::optional<Grant>());
    } else {
      ++it;
    }
  }
}

void Matchmaker::GiveTasks(double now_s) {
  if (waiting_.empty() || !dispatcher_.MayHaveWork(now_s)) return;
  const std::vector<std::string> serving = dispatcher_.roster().Serving(now_s);
  for (const size_t leases : {0, 1}) {
    for (auto it = waiting_.begin(); it != waiting_.end();) {
      const TaskRequest& request = (*it)->request;
      const bool may_take = !request.left.stop_requested() &&
                            dispatcher_.CountAt(request.session, request.slot) == leases &&
                            may_take_(request.session).ok();
      std::optional<Grant> grant =
          may_take ? dispatcher_.GrantNext(request.session, request.slot, serving, now_s)
                   : std::nullopt;
      if (!grant) {
        ++it;
        continue;
      }
      it = SettleAt(it, std::move(grant));
      if (!dispatcher_.MayHaveWork(now_s)) return;
    }
  }
}

}  // namespace orbweave
