// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

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

}  // namespace orbweave
