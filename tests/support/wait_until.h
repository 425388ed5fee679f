// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include "core/pipeline/coordinator_api.h"

namespace orbweave::testing {

/// Looks every few milliseconds whether `condition` holds; false when it does not within
/// `timeout_s`.
inline bool WaitUntil(const std::function<bool()>& condition, double timeout_s = 20.0) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

/// Waits for a job's end; its last status.
inline absl::StatusOr<JobStatus> WaitForEnd(CoordinatorApi& api,
                                            const Digest& job,
                                            double timeout_s = 20.0) {
  absl::StatusOr<JobStatus> status;
  WaitUntil(
      [&] {
        status = api.GetJob(job);
        return !status.ok() || status->state != JobState::kRunning;
      },
      timeout_s);
  return status;
}

}  // namespace orbweave::testing
