// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>

namespace orbweave {

/// Since when a worker has had no answer from its coordinator, and since when nothing to do. Time
/// is handed in, in seconds of any clock. Thread-safe.
class CoordinatorContact {
 public:
  /// `patience_s`: how long a coordinator that does not answer is waited for; `idle_s`: how long
  /// one that answers, and has nothing to do. Infinite: without end.
  CoordinatorContact(double patience_s, double idle_s, double now_s)
      : patience_s_(patience_s), idle_s_(idle_s), heard_s_(now_s), busy_s_(now_s) {}

  /// The coordinator answered; `is_busy`: there are tasks in hand.
  void Heard(bool is_busy, double now_s);
  /// It did not: who has nobody to ask is not idle.
  void NotHeard();
  /// A task was taken, or ended.
  void Worked(double now_s);

  /// Whether it is waited for no more.
  [[nodiscard]] bool IsGivenUp(double now_s) const;
  /// How long until there was nothing to do for too long; not above 0: there was.
  [[nodiscard]] double UntilIdle(double now_s) const;

 private:
  const double patience_s_;
  const double idle_s_;
  mutable std::mutex mutex_;
  double heard_s_;
  double busy_s_;
  bool is_away_ = true;
};

}  // namespace orbweave
