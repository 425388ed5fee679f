// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>

#include "core/base/clock.h"

namespace orbweave {

/// A clock turned by hand.
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
