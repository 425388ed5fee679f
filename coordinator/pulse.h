// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <limits>

#include "core/base/clock.h"

namespace orbweave {

/// When a thread last moved, told to others without a lock. One that waits for what may be away for
/// long and is none of its doing, the journal or a store, rests: that is not to stand still.
class Pulse {
 public:
  void Beat(double now_s) { last_s_ = now_s; }
  void Rest() { last_s_ = std::numeric_limits<double>::infinity(); }
  /// Whether it rests, as it does until its first beat, or beat within the last `period_s`.
  [[nodiscard]] bool IsFelt(double period_s, double now_s) const {
    return now_s - last_s_ <= period_s;
  }

 private:
  std::atomic<double> last_s_{std::numeric_limits<double>::infinity()};
};

/// Lets a thread rest until it is destroyed.
class PulseAtRest {
 public:
  PulseAtRest(Pulse& pulse, const Clock& clock) : pulse_(pulse), clock_(clock) { pulse_.Rest(); }
  ~PulseAtRest() { pulse_.Beat(clock_.NowSeconds()); }
  PulseAtRest(const PulseAtRest&) = delete;
  PulseAtRest& operator=(const PulseAtRest&) = delete;

 private:
  Pulse& pulse_;
  const Clock& clock_;
};

}  // namespace orbweave
