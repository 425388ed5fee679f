// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/retry.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>

namespace orbweave {

bool Backoff::Wait(const std::stop_token& stop) {
  constexpr double kLongest = 5.0;
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  never.wait_for(lock, stop, std::chrono::duration<double>(next_s_), [] { return false; });
  next_s_ = std::min(2.0 * next_s_, kLongest);
  return !stop.stop_requested();
}

}  // namespace orbweave
