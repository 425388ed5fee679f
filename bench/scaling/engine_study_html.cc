// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/engine_study_html.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "bench/scaling/engine_study_text.h"
#include "bench/scaling/line_chart.h"
#include "core/io/page/html_page.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

std::string Row(const std::vector<std::string>& cells) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) absl::StrAppend(&row, "<td>", cell, "</td>");
  return row + "</tr>";
}

std::string Table(const std::vector<std::string>& head, const std::string& rows) {
  std::string html = "<table><thead><tr>";
  for (const std::string& name : head) absl::StrAppend(&html, "<th>", name, "</th>");
  return absl::StrCat(html, "</tr></thead><tbody>", rows, "</tbody></table>");
}

std::string NameOf(const StudyPoint& point) {
  return absl::StrCat(ScalingKindName(point.kind),
                      ", ",
                      point.nodes,
                      point.nodes == 1 ? " node, " : " nodes, ",
                      CountText(point.panoramas),
                      " panoramas");
}

std::string About(const EngineStudy& study) {
  std::string list;
  for (const std::string& remark : RemarksOn(study))
    absl::StrAppend(&list, "<li>", EscapeHtml(remark), "</li>");
  return Section(
      "What was run",
      absl::StrCat(CountText(study.points.size()), " jobs by ", EscapeHtml(study.facts.engine)),
      "<ul>" + list + "</ul>");
}

std::vector<StudyPoint> PointsOf(const EngineStudy& study, ScalingKind kind) {
  std::vector<StudyPoint> points;
  for (const StudyPoint& point : study.points) {
    if (point.kind == kind) points.push_back(point);
  }
  return points;
}

std::string EfficiencyRows(const EngineStudy& study, ScalingKind kind) {
  std::string rows;
  for (const uint32_t nodes : NodesOf(study, kind)) {
    double least_s = HUGE_VAL;
    double most_s = 0.0;
    double efficiency = 0.0;
    uint32_t panoramas = 0;
    const double median_s = MedianWall(study, kind, nodes);
    for (const StudyPoint& point : PointsOf(study, kind)) {
      if (point.nodes != nodes) continue;
      least_s = std::min(least_s, point.wall_s);
      most_s = std::max(most_s, point.wall_s);
      panoramas = point.panoramas;
      if (point.wall_s == median_s) efficiency = point.efficiency;
    }
    rows += Row({CountText(nodes),
                 CountText(panoramas),
                 DecimalText(median_s, 1),
                 DecimalText(least_s, 1) + " to " + DecimalText(most_s, 1),
                 DecimalText(100.0 * efficiency, 0) + " %"});
  }
  return rows;
}

std::string Efficiency(const EngineStudy& study, ScalingKind kind, const std::string& words) {
  const std::vector<StudyPoint> points = PointsOf(study, kind);
  if (points.empty()) return "";
  ChartLine line{.name = "measured", .color = SeriesColor(0), .marks = true};
  double highest = 1.0;
  for (const StudyPoint& point : points) {
    line.points.push_back({point.nodes, point.efficiency});
    highest = std::max(highest, point.efficiency);
  }
  return Section(
      kind == ScalingKind::kStrong ? "Strong scaling, measured" : "Weak scaling, measured",
      words,
      LineChartSvg({line}, {.x = "nodes", .y = "efficiency", .log_y = false, .y_max = highest}) +
          Table({"nodes", "panoramas", "time s, median", "from, to", "efficiency"},
                EfficiencyRows(study, kind)));
}

std::string ShareBar(const TimeShares& shares) {
  std::string bar;
  int color = 0;
  for (const auto& [name, share] : TimeCauses()) {
    const double percent = 100.0 * shares.*share / shares.Sum();
    absl::StrAppend(&bar,
                    "<div title=\"",
                    name,
                    ": ",
                    DecimalText(percent, 1),
                    " %\" style=\"height:14px;width:",
                    DecimalText(percent, 3),
                    "%;background:",
                    SeriesColor(color++),
                    "\"></div>");
  }
  return "<div style=\"display:flex;min-width:10em\">" + bar + "</div>";
}

std::string TimeOfSlots(const EngineStudy& study) {
  std::string rows;
  std::vector<std::string> head = {"run", ""};
  for (const auto& cause : TimeCauses()) head.push_back(cause.first);
  for (const StudyPoint& point : study.points) {
    std::vector<std::string> cells = {NameOf(point), ShareBar(point.shares)};
    for (const auto& [name, share] : TimeCauses())
      cells.push_back(DecimalText(100.0 * point.shares.*share / point.shares.Sum(), 1) + " %");
    rows += Row(cells);
  }
  std::vector<ChartLine> key;
  for (const auto& cause : TimeCauses())
    key.push_back({.name = cause.first, .color = SeriesColor(static_cast<int>(key.size()))});
  return Section(
      "Where the time of slots went",
      "Of all slots from submission to end. Transfer: a task waits for blobs, or for a processor "
      "that others have. Lease: a slot waits though there are tasks, or hands one in. Barrier: "
      "others do the last tasks of a stage. Serial stage: another does its one task. Repeated: "
      "attempts that came to nothing.",
      Table(head, rows) + LineKeyHtml(key));
}

std::string Bytes(const EngineStudy& study) {
  std::string rows;
  bool has_links = false;
  for (const StudyPoint& point : study.points) {
    rows += Row({NameOf(point),
                 "tasks",
                 ShortText(1e-6 * static_cast<double>(point.read_bytes)),
                 ShortText(1e-6 * static_cast<double>(point.written_bytes))});
    for (const LinkTraffic& link : point.links) {
      has_links = true;
      rows += Row({NameOf(point),
                   EscapeHtml(link.node),
                   ShortText(1e-6 * static_cast<double>(link.in_bytes)),
                   ShortText(1e-6 * static_cast<double>(link.out_bytes))});
    }
  }
  return Section("Bytes by link",
                 absl::StrCat("What tasks read (from their worker's cache too) and wrote",
                              has_links ? ", and what came to and left each node by its network."
                                        : ". What went over the network was not counted."),
                 Table({"run", "link", "MB in", "MB out"}, rows));
}

std::string CoordinatorTable(const EngineStudy& study) {
  std::string rows;
  for (const StudyPoint& point : study.points) {
    rows += Row({NameOf(point),
                 DecimalText(point.coordinator_cpu_s, 2),
                 DecimalText(point.coordinator_ms_per_task, 2),
                 DecimalText(100.0 * point.coordinator_cpu_s / point.wall_s, 1) + " %"});
  }
  return Section("The coordinator",
                 "Processor time from submission to end.",
                 Table({"run", "CPU s", "ms a task", "of one processor"}, rows));
}

std::string Simulator(const EngineStudy& study) {
  std::string rows;
  for (const StudyPoint& point : study.points) {
    const bool is_right = std::abs(point.simulation_error) <= kMostSimulationError;
    rows += Row({NameOf(point),
                 DecimalText(point.wall_s, 2),
                 DecimalText(point.simulated_s, 2),
                 absl::StrFormat("%+.0f %%", 100.0 * point.simulation_error),
                 is_right ? "" : "off"});
  }
  return Section("The simulator against each run",
                 EscapeHtml(JudgeSimulator(study)),
                 Table({"run", "measured s", "simulated s", "error", ""}, rows));
}

}  // namespace

std::string EngineStudyHtml(const EngineStudy& study) {
  return About(study) + "<div class=\"pair\">" +
         Efficiency(
             study,
             ScalingKind::kStrong,
             "The same street on more nodes: time of the fewest over that of more, times the "
             "ratio of nodes.") +
         Efficiency(study,
                    ScalingKind::kWeak,
                    "A street that grows with the nodes: time of the fewest over that of more.") +
         "</div>" + TimeOfSlots(study) + Bytes(study) + CoordinatorTable(study) + Simulator(study);
}

}  // namespace orbweave
