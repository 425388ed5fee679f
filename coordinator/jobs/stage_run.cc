// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/jobs/stage_run.h"

#include <algorithm>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

/// About as long as it may take to lease a task and to hand its result in on a busy machine.
constexpr double kQuick_s = 0.25;

}  // namespace

std::optional<double> StageRun::mean_s() const {
  const uint32_t computed = done - reused;
  return computed > 0 ? std::optional(wall_s / computed) : earlier_mean_s;
}

double StageRun::usual_s() const {
  return durations_s.empty() ? earlier_mean_s.value_or(0.0) : median_s;
}

void StageRun::NoteDuration(double duration_s) {
  durations_s.push_back(duration_s);
  if (durations_s.size() <= median_of + median_of / 16) return;  // it changes little by then
  median_s = UpperMedian(durations_s);
  median_of = durations_s.size();
}

bool StageRun::IsQuick() const { return mean_s().value_or(kQuick_s) < kQuick_s; }

void StageRun::FindHomes(const StageRun& earlier) {
  earlier_mean_s = earlier.mean_s();
  homes.resize(tasks.size());
  for (uint32_t part = 0; part < std::min(tasks.size(), earlier.tasks.size()); ++part) {
    const TaskHolder& holder = earlier.tasks[part].done_by;
    homes[part] = {holder.worker, holder.slot};
  }
}

void StageRun::SetReady(uint32_t part) {
  ready.Insert(part);
  if (!homes.empty()) ready_at[homes[part]].insert(part);
}

bool StageRun::TakeReady(uint32_t part, const std::string& worker) {
  if (!ready.Erase(part)) return false;
  last_parts[worker] = part;
  if (homes.empty()) return true;
  const auto home = ready_at.find(homes[part]);
  home->second.erase(part);
  if (home->second.empty()) ready_at.erase(home);
  return true;
}

void StageRun::UpdateStragglerTime(const RetryPolicy& policy) {
  straggler_after_s.reset();
  const size_t computed = tasks.size() - reused;
  if (!ready.empty() || durations_s.empty() || 2 * durations_s.size() < computed) return;
  straggler_after_s = policy.StragglerAfter(UpperMedian(durations_s));
}

bool StageRun::HasReady(double now_s) const {
  const auto is_due = [&](uint32_t part) { return tasks[part].not_before_s <= now_s; };
  return ready.FindFirst(is_due).has_value();
}

bool StageRun::HasStraggler(double now_s) const {
  return straggler_after_s && std::ranges::any_of(running, [&](uint32_t part) {
           const std::vector<RunningAttempt>& attempts = tasks[part].attempts;
           return attempts.size() == 1 && IsLate(attempts.front(), now_s);
         });
}

bool StageRun::IsLate(const RunningAttempt& attempt, double now_s) const {
  return now_s - attempt.leased_s > *straggler_after_s;
}

std::optional<uint32_t> StageRun::FindStraggler(const std::string& worker,
                                                uint32_t slots,
                                                const RetryPolicy& policy,
                                                double now_s) const {
  if (!straggler_after_s) return std::nullopt;
  std::optional<uint32_t> found;
  uint32_t duplicates = 0;
  for (const uint32_t part : running) {
    const std::vector<RunningAttempt>& attempts = tasks[part].attempts;
    if (attempts.size() > 1) ++duplicates;
    const bool is_elsewhere = attempts.front().holder.worker != worker;
    if (!found && attempts.size() == 1 && IsLate(attempts.front(), now_s) && is_elsewhere)
      found = part;
  }
  return duplicates < policy.MaxDuplicates(slots) ? found : std::nullopt;
}

void StageRun::AddTo(StageStatus& status) const {
  status.tasks_total += static_cast<uint32_t>(tasks.size()) - repeated;
  status.tasks_done += done - repeated;
  status.tasks_reused += reused - repeated;
  status.tasks_running += static_cast<uint32_t>(running.size());
  status.retries += retries;
  if (first_lease_s) status.wall_s += std::max(0.0, last_result_s - *first_lease_s);
  status.cpu_s += cpu_s;
  ++status.runs;
  status.busy_s += wall_s;
  for (const uint32_t part : running) status.fraction_running += tasks[part].Fraction();
}

}  // namespace orbweave
