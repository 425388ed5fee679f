// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <stop_token>

#include "core/base/status.h"

namespace orbweave {

/// The waits between attempts to reach the coordinator or a store: 0.2 s, doubled up to 5 s, each
/// times a random number from 0.5 to 1, so that many who failed together do not come back together.
class Backoff {
 public:
  /// Waits the next time; ends early, with false, when `stop` is requested.
  bool Wait(const std::stop_token& stop);

 private:
  double longest_s_ = 0.2;  ///< of the next wait
};

/// How long a call is repeated.
struct RetryRule {
  std::stop_token stop{};
  /// The errors that may pass. Empty: Unavailable.
  std::function<bool(const absl::Status&)> is_passing{};
  /// Told such an error before every wait; false: no more attempts. Empty: on and on.
  std::function<bool(const absl::Status&)> goes_on{};

  /// Whether there is to be another attempt after `status`, but for the wait before it.
  [[nodiscard]] bool Repeats(const absl::Status& status) const;
};

/// What `call()` (a Status or StatusOr) answers at last: what is no passing error, or the error
/// after which `goes_on` said no or `stop` came.
template <typename Call>
auto Retry(const RetryRule& rule, Call&& call) -> decltype(call()) {
  Backoff backoff;
  while (true) {
    auto answer = call();
    const absl::Status status = internal::StatusOf(answer);
    if (!rule.Repeats(status) || !backoff.Wait(rule.stop)) return answer;
  }
}

}  // namespace orbweave
