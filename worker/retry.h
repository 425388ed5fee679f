// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>

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
/// `stop`.
template <typename Call>
auto RetryWhileUnavailable(const std::stop_token& stop, Call&& call) -> decltype(call()) {
  Backoff backoff;
  while (true) {
    auto answer = call();
    const absl::Status status = internal::StatusOf(answer);
    if (!absl::IsUnavailable(status) || !backoff.Wait(stop)) return answer;
  }
}

}  // namespace orbweave
