// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "coordinator/jobs/ready_parts.h"
#include "coordinator/jobs/task_record.h"

namespace orbweave {

/// The tasks of a stage, once it runs.
struct StageRun {
  uint32_t stage = 0;  ///< of the plan
  std::vector<TaskRecord> tasks{};
  ReadyParts ready{};
  std::set<uint32_t> running{};
  /// Of a loop's stage: where each part was done the last time (no name: nowhere), and the ready
  /// parts by that place.
  std::vector<WorkerSlot> homes{};
  std::map<WorkerSlot, std::set<uint32_t>> ready_at{};
  std::set<uint32_t> failed{};  ///< parts that are to be tried again, ready or running
  std::map<std::string, uint32_t> last_parts{};  ///< that workers were given
  uint32_t done = 0;
  uint32_t reused = 0;
  uint32_t repeated = 0;  ///< of `reused`: what an earlier round of a loop found or computed
  uint32_t retries = 0;
  std::optional<double> first_lease_s{};
  double last_result_s = 0.0;
  double cpu_s = 0.0;
  double wall_s = 0.0;                     ///< sum over tasks computed now
  std::optional<double> earlier_mean_s{};  ///< of a loop's stage: mean_s() of the run before
  std::vector<double> durations_s{};       ///< of the attempts whose results were taken
  double median_s = 0.0;                   ///< of durations_s, when it had median_of of them
  size_t median_of = 0;
  std::optional<double> straggler_after_s{};  ///< how long a task may run that nobody waits beside

  [[nodiscard]] bool IsDone() const { return done == tasks.size(); }
  /// How long a task takes: the mean of those computed now, or else of those of the run before.
  [[nodiscard]] std::optional<double> mean_s() const;
  /// How long a task usually takes: the median of those computed now, or else the mean of the run
  /// before; 0: nothing is known yet.
  [[nodiscard]] double usual_s() const;
  /// A task that was computed now took so long.
  void NoteDuration(double duration_s);
  /// Whether a task may as well wait behind another one for a while.
  [[nodiscard]] bool IsQuick() const;
  /// Looks up the homes of all parts in `earlier`, the run before; to be called before any is
  /// ready.
  void FindHomes(const StageRun& earlier);
  void SetReady(uint32_t part);
  /// `worker` is given a part; whether it was ready.
  bool TakeReady(uint32_t part, const std::string& worker);
  /// To be called when a task was leased, done or failed: stragglers there are only when no task is
  /// ready and half of those that are computed are done.
  void UpdateStragglerTime(const RetryPolicy& policy);
  /// Whether an attempt has run too long, where there are stragglers.
  [[nodiscard]] bool IsLate(const RunningAttempt& attempt, double now_s) const;
  /// Whether a task is ready whose time has come.
  [[nodiscard]] bool HasReady(double now_s) const;
  /// Whether a task has run too long, and nobody does it a second time.
  [[nodiscard]] bool HasStraggler(double now_s) const;
  /// The first straggler that `worker` does not do itself, unless as many run twice as may of all
  /// `slots`.
  [[nodiscard]] std::optional<uint32_t> FindStraggler(const std::string& worker,
                                                      uint32_t slots,
                                                      const RetryPolicy& policy,
                                                      double now_s) const;
  /// Adds this run to what is known of its stage, without what it repeats of another.
  void AddTo(StageStatus& status) const;
};

}  // namespace orbweave
