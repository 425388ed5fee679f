// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/simulate_schedule.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>

#include "core/base/status.h"

namespace orbweave {
namespace {

double TransferSeconds(double bytes, double gbit_per_s) { return 8e-9 * bytes / gbit_per_s; }

double TaskSeconds(const PartLoad& part, uint32_t at_once, const FleetModel& model) {
  return model.task_overhead_s + part.compute_s / model.processors_per_slot +
         TransferSeconds(part.bytes, model.worker_gbit_per_s / at_once);
}

/// What the coordinator needs for a run, however many workers there are.
double CoordinatorSeconds(const StageLoad& run, const FleetModel& model) {
  double bytes = 0.0;
  for (const PartLoad& part : run.parts) bytes += part.bytes;
  return std::max(TransferSeconds(bytes, model.coordinator_gbit_per_s),
                  static_cast<double>(run.parts.size()) * model.coordinator_s_per_task);
}

double ListSchedule(const StageLoad& run, uint32_t workers, const FleetModel& model) {
  const uint32_t at_once = TasksAtOnce(model.offers, model.slots, run.needs);
  if (at_once == 0 && !run.parts.empty()) return std::numeric_limits<double>::infinity();
  std::priority_queue<double, std::vector<double>, std::greater<>> free_at;
  const size_t lanes = std::min(size_t{workers} * at_once, run.parts.size());
  for (size_t lane = 0; lane < lanes; ++lane) free_at.push(0.0);
  double end_s = 0.0;
  for (const PartLoad& part : run.parts) {
    const double done_s = free_at.top() + TaskSeconds(part, at_once, model);
    free_at.pop();
    free_at.push(done_s);
    end_s = std::max(end_s, done_s);
  }
  return end_s;
}

Schedule InOrder(const std::vector<StageLoad>& runs,
                 const FleetModel& model,
                 const std::function<double(const StageLoad&)>& seconds_of) {
  Schedule schedule;
  for (const StageLoad& run : runs) {
    schedule.run_s.push_back(model.stage_overhead_s + seconds_of(run));
    schedule.makespan_s += schedule.run_s.back();
  }
  return schedule;
}

}  // namespace

std::vector<StageLoad> StageLoadsOf(const std::vector<MeasuredTask>& tasks) {
  std::vector<StageLoad> runs;
  for (size_t i = 0; i < tasks.size(); ++i) {
    if (i == 0 || tasks[i].run != tasks[i - 1].run) runs.push_back({.stage = tasks[i].stage});
    const TaskCost& cost = tasks[i].cost;
    runs.back().parts.push_back(
        {cost.cpu_s, static_cast<double>(cost.bytes_in) + static_cast<double>(cost.bytes_out)});
  }
  return runs;
}

Schedule SimulateSchedule(const std::vector<StageLoad>& runs,
                          uint32_t workers,
                          const FleetModel& model) {
  ORBWEAVE_CHECK(workers > 0);
  return InOrder(runs, model, [&](const StageLoad& run) {
    return std::max(ListSchedule(run, workers, model), CoordinatorSeconds(run, model));
  });
}

Schedule CriticalPath(const std::vector<StageLoad>& runs, const FleetModel& model) {
  return InOrder(runs, model, [&](const StageLoad& run) {
    if (TasksAtOnce(model.offers, model.slots, run.needs) == 0 && !run.parts.empty())
      return std::numeric_limits<double>::infinity();
    double longest_s = 0.0;
    for (const PartLoad& part : run.parts)
      longest_s = std::max(longest_s, TaskSeconds(part, 1, model));
    return longest_s;
  });
}

}  // namespace orbweave
