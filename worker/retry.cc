// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/retry.h"

#include <algorithm>

#include "core/base/sleep.h"

namespace orbweave {

bool Backoff::Wait(const std::stop_token& stop) {
  constexpr double kLongest = 5.0;
  const bool goes_on = SleepUnlessStopped(next_s_, stop);
  next_s_ = std::min(2.0 * next_s_, kLongest);
  return goes_on;
}

bool RetryRule::Repeats(const absl::Status& status) const {
  if (status.ok() || stop.stop_requested()) return false;
  if (!(is_passing ? is_passing(status) : absl::IsUnavailable(status))) return false;
  return !goes_on || goes_on(status);
}

}  // namespace orbweave
