// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "coordinator/task_record.h"

namespace orbweave {

/// The tasks of a stage, once it runs.
struct StageRun {
  uint32_t stage = 0;                ///< of the plan
  std::optional<uint32_t> before{};  ///< the run of the same stage before this one
  std::vector<TaskRecord> tasks{};
  std::set<uint32_t> ready{};
  std::set<uint32_t> running{};
  uint32_t done = 0;
  uint32_t reused = 0;
  uint32_t retries = 0;
  std::optional<double> first_lease_s{};
  double last_result_s = 0.0;
  double cpu_s = 0.0;
  std::vector<double> durations_s{};          ///< of the attempts whose results were taken
  std::optional<double> straggler_after_s{};  ///< how long a task may run that nobody waits beside

  [[nodiscard]] bool IsDone() const { return done == tasks.size(); }
  /// To be called when a task was leased, done or failed: stragglers there are only when no task is
  /// ready and half of those that are computed are done.
  void UpdateStragglerTime(const RetryPolicy& policy);
  /// The first straggler that `worker` does not do itself, unless as many run twice as may of all
  /// `slots`.
  [[nodiscard]] std::optional<uint32_t> FindStraggler(const std::string& worker,
                                                      uint32_t slots,
                                                      const RetryPolicy& policy,
                                                      double now_s) const;
  /// Adds this run to what is known of its stage.
  void AddTo(StageStatus& status) const;
};

}  // namespace orbweave
