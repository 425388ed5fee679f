// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/share_time.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace orbweave {
namespace {

struct Interval {
  double begin_s = 0.0;
  double end_s = 0.0;
};

/// What a slot without a task waits for, for a while.
struct Phase {
  Interval when{};
  double TimeShares::*cause = &TimeShares::planning_s;
};

struct RunSpan {
  double first_start_s = std::numeric_limits<double>::infinity();
  double last_start_s = 0.0;
  double end_s = 0.0;
  std::set<uint32_t> parts{};
};

std::map<uint32_t, RunSpan> SpansOf(const std::vector<TaskTiming>& timings) {
  std::map<uint32_t, RunSpan> spans;
  for (const TaskTiming& timing : timings) {
    RunSpan& span = spans[timing.run];
    span.first_start_s = std::min(span.first_start_s, timing.start_s);
    span.last_start_s = std::max(span.last_start_s, timing.start_s);
    span.end_s = std::max(span.end_s, timing.end_s);
    span.parts.insert(timing.part);
  }
  return spans;
}

/// From 0 to `wall_s` without a gap.
std::vector<Phase> PhasesOf(const std::vector<TaskTiming>& timings, double wall_s) {
  std::vector<Phase> phases;
  double now_s = 0.0;
  const auto go_on = [&](double to_s, double TimeShares::*cause) {
    to_s = std::min(to_s, wall_s);
    if (to_s <= now_s) return;
    phases.push_back({{now_s, to_s}, cause});
    now_s = to_s;
  };
  for (const auto& [run, span] : SpansOf(timings)) {
    go_on(span.first_start_s, &TimeShares::planning_s);
    const bool is_serial = span.parts.size() == 1;
    if (!is_serial) go_on(span.last_start_s, &TimeShares::leasing_s);
    go_on(span.end_s, is_serial ? &TimeShares::serial_s : &TimeShares::barrier_s);
  }
  go_on(wall_s, &TimeShares::planning_s);
  return phases;
}

void AddIdle(const Interval& idle, const std::vector<Phase>& phases, TimeShares& shares) {
  for (const Phase& phase : phases) {
    const double common_s =
        std::min(idle.end_s, phase.when.end_s) - std::max(idle.begin_s, phase.when.begin_s);
    if (common_s > 0.0) shares.*phase.cause += common_s;
  }
}

using CostOf = std::map<std::pair<uint32_t, uint32_t>, const TaskCost*>;

void AddAttempt(const TaskTiming& timing,
                const CostOf& costs,
                double processors,
                TimeShares& shares) {
  const double held_s = std::max(0.0, timing.end_s - timing.start_s);
  const auto cost = costs.find({timing.run, timing.part});
  if (!timing.ok || cost == costs.end()) {
    shares.repeated_s += held_s;
    return;
  }
  const double computing_s = std::min(cost->second->cpu_s / processors, held_s);
  const double waiting_s =
      std::clamp(cost->second->wall_s - computing_s, 0.0, held_s - computing_s);
  shares.computing_s += computing_s;
  shares.waiting_s += waiting_s;
  shares.leasing_s += held_s - computing_s - waiting_s;
}

}  // namespace

TimeShares ShareTime(const std::vector<TaskTiming>& timings,
                     const std::vector<MeasuredTask>& tasks,
                     uint32_t slots,
                     double processors_per_slot,
                     double wall_s) {
  CostOf costs;
  for (const MeasuredTask& task : tasks) costs[{task.run, task.part}] = &task.cost;
  std::map<std::pair<std::string, uint32_t>, std::vector<Interval>> busy;
  TimeShares shares;
  for (const TaskTiming& timing : timings) {
    AddAttempt(timing, costs, processors_per_slot, shares);
    busy[{timing.worker, timing.slot}].push_back({timing.start_s, timing.end_s});
  }
  const std::vector<Phase> phases = PhasesOf(timings, wall_s);
  for (auto& [slot, attempts] : busy) {
    std::ranges::sort(attempts, {}, &Interval::begin_s);
    double free_s = 0.0;
    for (const Interval& attempt : attempts) {
      AddIdle({free_s, attempt.begin_s}, phases, shares);
      free_s = std::max(free_s, attempt.end_s);
    }
    AddIdle({free_s, wall_s}, phases, shares);
  }
  for (size_t unused = busy.size(); unused < slots; ++unused)
    AddIdle({0.0, wall_s}, phases, shares);
  return shares;
}

}  // namespace orbweave
