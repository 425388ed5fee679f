// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/trace_json.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "absl/strings/str_cat.h"
#include "core/io/json_text.h"
#include "core/io/natural_order.h"

namespace orbweave {
namespace {

struct ByNaturalOrder {
  bool operator()(const std::string& a, const std::string& b) const { return NaturalLess(a, b); }
};

/// Process number of each worker and the slots it used.
struct Lane {
  int process = 0;
  std::set<uint32_t> slots{};
};
using Lanes = std::map<std::string, Lane, ByNaturalOrder>;

Lanes LanesOf(const std::vector<TraceRow>& rows) {
  Lanes lanes;
  for (const TraceRow& row : rows) lanes[row.worker].slots.insert(row.slot);
  int process = 0;
  for (auto& [worker, lane] : lanes) lane.process = ++process;
  return lanes;
}

Json NameEvent(const char* what, int process, uint32_t thread, const std::string& name) {
  return {
      {"ph", "M"}, {"name", what}, {"pid", process}, {"tid", thread}, {"args", {{"name", name}}}};
}

int64_t Microseconds(double seconds) { return static_cast<int64_t>(std::llround(seconds * 1e6)); }

Json BarOf(const TraceRow& row, int process) {
  const int64_t start_us = Microseconds(row.start_s);
  return {{"ph", "X"},
          {"name", absl::StrCat(row.stage, " ", row.part)},
          {"cat", row.ok ? "task" : "failed"},
          {"pid", process},
          {"tid", row.slot},
          {"ts", start_us},
          {"dur", std::max<int64_t>(Microseconds(row.end_s) - start_us, 0)},
          {"args", {{"stage", row.stage}, {"part", row.part}, {"ok", row.ok}}}};
}

}  // namespace

std::string TraceJson(std::vector<TraceRow> rows) {
  std::sort(rows.begin(), rows.end(), [](const TraceRow& a, const TraceRow& b) {
    return std::tie(a.start_s, a.worker, a.slot, a.stage, a.part, a.end_s) <
           std::tie(b.start_s, b.worker, b.slot, b.stage, b.part, b.end_s);
  });
  const Lanes lanes = LanesOf(rows);
  Json events = Json::array();
  for (const auto& [worker, lane] : lanes) {
    events.push_back(NameEvent("process_name", lane.process, 0, worker));
    for (const uint32_t slot : lane.slots) {
      events.push_back(NameEvent("thread_name", lane.process, slot, absl::StrCat("slot ", slot)));
    }
  }
  for (const TraceRow& row : rows) events.push_back(BarOf(row, lanes.at(row.worker).process));
  return JsonText({{"displayTimeUnit", "ms"}, {"traceEvents", std::move(events)}}, -1);
}

}  // namespace orbweave
