// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/retry.h"

#include <algorithm>
#include <random>

#include "core/base/sleep.h"

namespace orbweave {

bool Backoff::Wait(const std::stop_token& stop) {
  constexpr double kLongest_s = 5.0;
  thread_local std::mt19937 generator{std::random_device{}()};
  std::uniform_real_distribution<double> spread(0.5, 1.0);
  const bool goes_on = SleepUnlessStopped(longest_s_ * spread(generator), stop);
  longest_s_ = std::min(2.0 * longest_s_, kLongest_s);
  return goes_on;
}

bool RetryRule::Repeats(const absl::Status& status) const {
  if (status.ok() || stop.stop_requested()) return false;
  if (!(is_passing ? is_passing(status) : absl::IsUnavailable(status))) return false;
  return !goes_on || goes_on(status);
}

}  // namespace orbweave
