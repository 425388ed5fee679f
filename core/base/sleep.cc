// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/sleep.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>

namespace orbweave {

bool SleepUnlessStopped(double seconds, const std::stop_token& stop) {
  constexpr double kLongest_s = 1e8;  // three years: longer ones overflow the clock
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  never.wait_for(lock, stop, std::chrono::duration<double>(std::min(seconds, kLongest_s)), [] {
    return false;
  });
  return !stop.stop_requested();
}

void SleepUntilStopped(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  never.wait(lock, stop, [] { return false; });
}

}  // namespace orbweave
