// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/stage_totals.h"

#include <algorithm>

namespace orbweave {
namespace {

StageTotals& TotalsOf(const std::string& stage, std::vector<StageTotals>& totals) {
  const auto found = std::find_if(
      totals.begin(), totals.end(), [&](const StageTotals& entry) { return entry.stage == stage; });
  return found != totals.end() ? *found : totals.emplace_back(StageTotals{.stage = stage});
}

void AddTo(StageTotals& total, const TaskCost& cost) {
  ++total.tasks;
  total.cpu_s += cost.cpu_s;
  total.bytes_in += cost.bytes_in;
  total.bytes_out += cost.bytes_out;
  total.peak_memory_bytes = std::max(total.peak_memory_bytes, cost.peak_memory_bytes);
}

}  // namespace

std::vector<StageTotals> SumByStage(const std::vector<MeasuredTask>& tasks) {
  std::vector<StageTotals> totals;
  for (size_t begin = 0; begin < tasks.size();) {
    StageTotals& total = TotalsOf(tasks[begin].stage, totals);
    double longest_s = 0.0;
    size_t end = begin;
    for (; end < tasks.size() && tasks[end].run == tasks[begin].run; ++end) {
      AddTo(total, tasks[end].cost);
      longest_s = std::max(longest_s, tasks[end].cost.cpu_s);
    }
    total.longest_cpu_s += longest_s;
    ++total.runs;
    begin = end;
  }
  return totals;
}

}  // namespace orbweave
