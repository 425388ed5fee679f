// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/jobs/retry_policy.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/random.h"

namespace orbweave {

FailureClass ClassifyFailure(absl::StatusCode code) {
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
    case absl::StatusCode::kUnauthenticated:
    case absl::StatusCode::kUnimplemented:
      return FailureClass::kPermanent;
    case absl::StatusCode::kUnavailable:
    case absl::StatusCode::kResourceExhausted:
      return FailureClass::kInfrastructure;
    case absl::StatusCode::kAborted:
    case absl::StatusCode::kDeadlineExceeded:
      return FailureClass::kProcessLost;
    default:
      return FailureClass::kTransient;
  }
}

uint32_t RetryPolicy::MaxFailures(FailureClass failure) const {
  switch (failure) {
    case FailureClass::kReturned:
      return 0;
    case FailureClass::kPermanent:
      return max_permanent;
    case FailureClass::kTransient:
    case FailureClass::kInputLost:
      return max_transient;
    case FailureClass::kInfrastructure:
      return max_infrastructure;
    case FailureClass::kProcessLost:
      return max_process_lost;
  }
  return 1;
}

uint32_t RetryPolicy::MaxJobRetries(size_t tasks) const {
  return job_retries + static_cast<uint32_t>(job_retry_share * static_cast<double>(tasks));
}

double RetryPolicy::WaitAfter(uint32_t failures, uint64_t seed) const {
  const double doubled_s = first_wait_s * std::exp2(static_cast<double>(failures) - 1.0);
  return std::min(longest_wait_s, doubled_s) * Random(seed + failures).Uniform(0.5, 1.0);
}

double RetryPolicy::StragglerAfter(double median_s) const {
  return std::max(straggler_least_s, straggler_factor * median_s);
}

uint32_t RetryPolicy::MaxDuplicates(uint32_t slots) const {
  return std::max(uint32_t{1}, static_cast<uint32_t>(duplicate_share * slots));
}

uint32_t FailureCounts::Total() const {
  return std::accumulate(counts_.begin(), counts_.end(), uint32_t{0});
}

}  // namespace orbweave
