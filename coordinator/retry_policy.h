// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/status.h"

namespace orbweave {

/// What the coordinator makes of an attempt that did not end well.
enum class FailureClass : uint8_t {
  kReturned,   ///< given back unharmed; does not count
  kInputLost,  ///< an input is gone or damaged: what made it is to run again
  kPermanent,  ///< would fail anywhere: the job fails
  kTransient,  ///< may succeed elsewhere or later
};

[[nodiscard]] inline FailureClass ClassifyFailure(absl::StatusCode code) {
  switch (code) {
    case absl::StatusCode::kCancelled:
      return FailureClass::kReturned;
    case absl::StatusCode::kNotFound:
    case absl::StatusCode::kDataLoss:
      return FailureClass::kInputLost;
    case absl::StatusCode::kInvalidArgument:
    case absl::StatusCode::kFailedPrecondition:
    case absl::StatusCode::kOutOfRange:
    case absl::StatusCode::kAlreadyExists:
    case absl::StatusCode::kPermissionDenied:
    case absl::StatusCode::kUnimplemented:
      return FailureClass::kPermanent;
    default:
      return FailureClass::kTransient;
  }
}

/// How often and how soon a task is tried again.
struct RetryPolicy {
  uint32_t max_attempts = 5;  ///< failed attempts after which the job fails
  double first_wait_s = 0.5;  ///< before the second attempt; doubles with every further one
  double longest_wait_s = 30;

  [[nodiscard]] double WaitAfter(uint32_t failures) const {
    return std::min(longest_wait_s, first_wait_s * std::exp2(static_cast<double>(failures) - 1.0));
  }
};

}  // namespace orbweave
