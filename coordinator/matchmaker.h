// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "coordinator/dispatcher.h"
#include "core/base/clock.h"

namespace orbweave {

/// Who asks for a task, and for how long.
struct TaskRequest {
  uint64_t session = 0;
  uint32_t slot = 0;
  double until_s = 0.0;    ///< by the coordinator's clock
  std::stop_token left{};  ///< nobody waits any more
};

/// The slots that wait for tasks, and the coordinator's thread that gives them what becomes ready:
/// those that wait sleep until there is something for them. Where several may have a task, idle
/// slots come before those that would do it after another one, and who waits longest comes first.
/// What it is given outlives it.
class Matchmaker {
 public:
  /// Whether a session may be given tasks; why not. With the lock.
  using MayTake = std::function<absl::Status(uint64_t session)>;

  /// `mutex` guards `dispatcher`.
  Matchmaker(std::mutex& mutex, Dispatcher& dispatcher, const Clock& clock, MayTake may_take)
      : mutex_(mutex), dispatcher_(dispatcher), clock_(clock), may_take_(std::move(may_take)) {}

  void Start();
  /// A task, at once or when one is ready; nothing: until the request's end none was. Cancelled:
  /// it left. Errors of `may_take`. `lock` is of the mutex.
  [[nodiscard]] absl::StatusOr<std::optional<Grant>> Await(std::unique_lock<std::mutex>& lock,
                                                           const TaskRequest& request);
  /// With the lock: there may be a task for somebody who waits.
  void Wake();
  /// With the lock: somebody who waits may be told to go.
  void WakeAll();

 private:
  using Answer = absl::StatusOr<std::optional<Grant>>;
  struct Waiting {
    TaskRequest request{};
    std::optional<Answer> answer{};
    std::condition_variable answered{};
  };

  void Run(const std::stop_token& stop);
  /// What the clock brings: leases that end, waits that are over; and who may take no more.
  void LookAtAll(double now_s);
  void GiveTasks(double now_s);
  static void Tell(Waiting& waiting, Answer answer);

  std::mutex& mutex_;
  Dispatcher& dispatcher_;
  const Clock& clock_;
  MayTake may_take_;
  std::list<Waiting> waiting_;  ///< in the order in which they came
  bool is_woken_ = false;
  bool looks_at_all_ = false;
  std::condition_variable_any woken_;
  std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace orbweave
