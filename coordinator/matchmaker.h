// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <condition_variable>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

#include "coordinator/dispatcher.h"
#include "coordinator/pulse.h"
#include "coordinator/task_call.h"
#include "core/base/clock.h"

namespace orbweave {

/// The slots that wait for tasks, and the coordinator's thread that gives them what becomes ready.
/// A slot that waits costs memory and no thread, and there is one question of it at a time. Where
/// several may have a task, idle slots come before those that would do it after another one, and
/// who waits longest comes first. What it is given outlives it.
class Matchmaker {
 public:
  /// Whether a session may be given tasks; why not. With the lock.
  using MayTake = std::function<absl::Status(uint64_t session)>;
  /// Told what came of each question. With the lock: quick.
  using Settle = std::function<void(TaskAnswer answer)>;

  /// `mutex` guards `dispatcher`.
  Matchmaker(std::mutex& mutex,
             Dispatcher& dispatcher,
             const Clock& clock,
             MayTake may_take,
             Settle settle)
      : mutex_(mutex),
        dispatcher_(dispatcher),
        clock_(clock),
        may_take_(std::move(may_take)),
        settle_(std::move(settle)) {}

  void Start();
  /// Tells all that wait that it is over, and ends.
  void End();
  /// Settles a question: by a task, at once or when one is ready; by nothing, when until the
  /// request's end none was; by Aborted, when the slot asks anew; by Cancelled, when it left; or by
  /// an error of `may_take`. `lock` is of the mutex, and is given back.
  void Ask(std::unique_lock<std::mutex> lock, TaskRequest request, TakeLease take);
  /// With the lock: there may be a task for somebody who waits.
  void Wake();
  /// With the lock: somebody who waits may be told to go.
  void WakeAll();
  /// With the lock.
  [[nodiscard]] size_t num_waiting() const { return waiting_.size(); }
  [[nodiscard]] const Pulse& pulse() const { return pulse_; }

 private:
  using Waiting = std::list<std::shared_ptr<TaskCall>>;
  using Place = std::pair<uint64_t, uint32_t>;  ///< session and slot
  [[nodiscard]] static Place PlaceOf(const TaskRequest& request) {
    return {request.session, request.slot};
  }

  void Run(const std::stop_token& stop);
  /// What the clock brings: leases that end, waits that are over; and who may take no more.
  void LookAtAll(double now_s);
  void GiveTasks(double now_s);
  /// The one who asked is not there any more.
  void Leave(const TaskCall& call);
  /// Settles a question that waited; the next one.
  Waiting::iterator SettleAt(Waiting::iterator it, absl::StatusOr<std::optional<Grant>> grant);

  std::mutex& mutex_;
  Dispatcher& dispatcher_;
  const Clock& clock_;
  MayTake may_take_;
  Settle settle_;
  Waiting waiting_;  ///< in the order in which they came
  std::map<Place, Waiting::iterator> places_;
  bool is_woken_ = false;
  bool looks_at_all_ = false;
  Pulse pulse_;
  std::condition_variable_any woken_;
  std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace orbweave
