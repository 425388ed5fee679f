// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "coordinator/dispatcher.h"
#include "coordinator/journal/journal.h"
#include "coordinator/task_call.h"
#include "core/base/clock.h"

namespace orbweave {

/// A journal that is another coordinator's is none that refuses a worker: the other takes its
/// result.
[[nodiscard]] absl::Status ForWorkers(const absl::Status& saved);

/// Where tasks are handed out: a lease leaves the house only when it is written down. One thread
/// writes down all that was granted meanwhile in one go, and another tells those who get nothing,
/// so that they do not wait for the disk. What it is given outlives it.
class LeaseDesk {
 public:
  /// `mutex` guards `dispatcher`.
  LeaseDesk(std::mutex& mutex, Dispatcher& dispatcher, Journal& journal, const Clock& clock)
      : mutex_(mutex), dispatcher_(dispatcher), journal_(journal), clock_(clock) {}

  void Start();
  /// Tells all that was settled, and ends.
  void End();
  /// Quick; with the mutex or without it.
  void Settle(TaskAnswer answer);

 private:
  /// Answers that wait for a thread.
  struct Queue {
    std::mutex mutex{};
    std::condition_variable_any changed{};
    std::vector<TaskAnswer> answers{};
  };
  /// What is done with all that has gathered in a queue.
  using Round = std::function<void(const std::vector<TaskAnswer>& answers)>;
  static void Serve(Queue& queue, const std::stop_token& stop, const Round& round);
  void HandOut(const std::vector<TaskAnswer>& granted);
  static void Tell(const std::vector<TaskAnswer>& answers);
  /// With the lock: what a worker is told whose grant was `saved`.
  [[nodiscard]] absl::StatusOr<std::optional<Lease>> Conclude(const TaskRequest& request,
                                                              const Grant& grant,
                                                              const absl::Status& saved);
  /// With the lock: a lease that was granted goes to nobody.
  void TakeBack(uint64_t session, const Grant& grant, const std::string& reason);

  std::mutex& mutex_;
  Dispatcher& dispatcher_;
  Journal& journal_;
  const Clock& clock_;
  Queue granted_;
  Queue others_;
  std::jthread writer_;  ///< last, as the next: they end before what they use
  std::jthread teller_;
};

}  // namespace orbweave
