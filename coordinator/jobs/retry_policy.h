// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/status.h"

namespace orbweave {

/// What the coordinator makes of an attempt that did not end well.
enum class FailureClass : uint8_t {
  kReturned,        ///< given back unharmed; does not count
  kInputLost,       ///< an input is gone or damaged: what made it is to run again
  kPermanent,       ///< would fail anywhere, if it is true: another worker is to say so too
  kTransient,       ///< the stage failed in a way that may not happen again
  kInfrastructure,  ///< a worker, a store or a machine failed, not the task
  kProcessLost,     ///< the task's process died or had to be killed: it may be the task's fault
};
inline constexpr size_t kNumFailureClasses = 6;

/// The table of all codes.
[[nodiscard]] FailureClass ClassifyFailure(absl::StatusCode code);

/// How often and how soon a task is tried again, and when a second worker is to try it as well.
struct RetryPolicy {
  /// Attempts that may fail before the job does, by reason.
  uint32_t max_transient = 3;
  uint32_t max_infrastructure = 5;
  uint32_t max_process_lost = 3;
  /// Where another worker may try; 1 where there is none. One that is broken or means ill cannot
  /// fail a job by its word alone.
  uint32_t max_permanent = 2;
  /// Retries of a whole job: a number, and a share of its tasks. More are a storm.
  uint32_t job_retries = 50;
  double job_retry_share = 0.1;

  double first_wait_s = 0.5;  ///< before the second attempt at most; doubles with every further one
  double longest_wait_s = 30.0;

  /// A task is a straggler once it runs `straggler_factor` times as long as the median of its
  /// stage, and `straggler_least_s` at least. It gets a second attempt where a slot has nothing
  /// else to do; no more than this share of all slots (but one) is for such.
  double straggler_factor = 2.0;
  double straggler_least_s = 60.0;
  double duplicate_share = 0.1;

  /// Failed attempts of this class after which the job fails; 0: it never does.
  [[nodiscard]] uint32_t MaxFailures(FailureClass failure) const;
  [[nodiscard]] uint32_t MaxJobRetries(size_t tasks) const;
  /// Half to the whole of the wait, drawn from the task's seed: tasks that failed together do not
  /// come back together.
  [[nodiscard]] double WaitAfter(uint32_t failures, uint64_t seed) const;
  [[nodiscard]] double StragglerAfter(double median_s) const;
  [[nodiscard]] uint32_t MaxDuplicates(uint32_t slots) const;
};

/// Failed attempts of a task, by class.
class FailureCounts {
 public:
  void Add(FailureClass failure) { ++counts_[static_cast<size_t>(failure)]; }
  [[nodiscard]] uint32_t Of(FailureClass failure) const {
    return counts_[static_cast<size_t>(failure)];
  }
  [[nodiscard]] uint32_t Total() const;

 private:
  std::array<uint32_t, kNumFailureClasses> counts_{};
};

}  // namespace orbweave
