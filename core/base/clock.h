// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace orbweave {

/// Time since an arbitrary start, in seconds. Code that waits or measures takes a `Clock&`.
class Clock {
 public:
  virtual ~Clock() = default;
  [[nodiscard]] virtual double NowSeconds() const = 0;
};

/// The machine's monotonic clock.
class SteadyClock final : public Clock {
 public:
  [[nodiscard]] double NowSeconds() const override {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
};

/// A clock turned by hand, for tests.
class ManualClock final : public Clock {
 public:
  [[nodiscard]] double NowSeconds() const override {
    const std::lock_guard lock(mutex_);
    return now_s_;
  }
  void Advance(double seconds) {
    const std::lock_guard lock(mutex_);
    now_s_ += seconds;
  }

 private:
  mutable std::mutex mutex_;
  double now_s_ = 0.0;
};

}  // namespace orbweave
