// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/measure_overhead.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

double Median(std::vector<double> values) {
  return values.empty() ? 0.0 : UpperMedian(std::move(values));
}

double MedianHold(const std::vector<TaskTiming>& timings, const std::vector<MeasuredTask>& tasks) {
  std::map<std::pair<uint32_t, uint32_t>, double> wall_s;
  for (const MeasuredTask& task : tasks) wall_s[{task.run, task.part}] = task.cost.wall_s;
  std::vector<double> holds;
  for (const TaskTiming& timing : timings) {
    const auto found = wall_s.find({timing.run, timing.part});
    if (!timing.ok || found == wall_s.end()) continue;
    holds.push_back(std::max(0.0, timing.end_s - timing.start_s - found->second));
  }
  return Median(std::move(holds));
}

/// Between two tasks of a slot in one run. `timings` in order of their end.
double MedianWait(const std::vector<TaskTiming>& timings) {
  std::map<std::pair<std::string, uint32_t>, const TaskTiming*> last;
  std::vector<double> waits;
  for (const TaskTiming& timing : timings) {
    const TaskTiming*& before = last[{timing.worker, timing.slot}];
    if (before != nullptr && before->run == timing.run)
      waits.push_back(std::max(0.0, timing.start_s - before->end_s));
    before = &timing;
  }
  return Median(std::move(waits));
}

double MedianBreak(const std::vector<TaskTiming>& timings) {
  struct Span {
    double start_s = std::numeric_limits<double>::infinity();
    double end_s = 0.0;
  };
  std::map<uint32_t, Span> runs;
  for (const TaskTiming& timing : timings) {
    Span& span = runs[timing.run];
    span.start_s = std::min(span.start_s, timing.start_s);
    span.end_s = std::max(span.end_s, timing.end_s);
  }
  std::vector<double> breaks;
  double end_s = 0.0;
  for (const auto& [run, span] : runs) {
    breaks.push_back(std::max(0.0, span.start_s - end_s));
    end_s = span.end_s;
  }
  return Median(std::move(breaks));
}

}  // namespace

ScheduleOverhead MeasureOverhead(const std::vector<TaskTiming>& timings,
                                 const std::vector<MeasuredTask>& tasks) {
  return {.task_s = MedianHold(timings, tasks) + MedianWait(timings),
          .stage_s = MedianBreak(timings)};
}

}  // namespace orbweave
