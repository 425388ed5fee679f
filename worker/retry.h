// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>
#include <utility>

#include "core/base/status.h"

namespace orbweave {

/// The waits between attempts to reach the coordinator: 0.2 s, doubled up to 5 s.
class Backoff {
 public:
  /// Waits the next time; ends early, with false, when `stop` is requested.
  bool Wait(const std::stop_token& stop);

 private:
  double next_s_ = 0.2;
};

/// Calls `call()` (a Status or StatusOr) until it returns another code than Unavailable, or until
/// `stop`; before every wait says why to `waits(status)`.
template <typename Call, typename Waits>
auto RetryWhileUnavailable(const std::stop_token& stop, Call&& call, Waits&& waits)
    -> decltype(call()) {
  Backoff backoff;
  while (true) {
    auto answer = call();
    const absl::Status status = internal::StatusOf(answer);
    if (!absl::IsUnavailable(status)) return answer;
    waits(status);
    if (!backoff.Wait(stop)) return answer;
  }
}

template <typename Call>
auto RetryWhileUnavailable(const std::stop_token& stop, Call&& call) -> decltype(call()) {
  return RetryWhileUnavailable(stop, std::forward<Call>(call), [](const absl::Status&) {});
}

}  // namespace orbweave
