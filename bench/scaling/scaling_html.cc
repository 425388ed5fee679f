// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/scaling_html.h"

#include <numeric>

#include "absl/strings/str_cat.h"
#include "bench/scaling/engine_study_html.h"
#include "bench/scaling/line_chart.h"
#include "bench/scaling/scaling_tables.h"
#include "core/io/page/html_page.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

std::string NameOf(const ScalingPrediction& prediction) {
  return absl::StrCat(CountText(prediction.panoramas),
                      " panoramas, ",
                      prediction.extrapolated ? "simulated, extrapolated" : "simulated");
}

using PointValue = double (*)(const ScalingPoint&);
using RunValue = double (*)(const ScalingRun&);

/// A line per prediction, and the measured runs of the largest job as marks.
std::vector<ChartLine> LinesOver(const ScalingReport& report, PointValue value, RunValue measured) {
  std::vector<ChartLine> lines;
  for (const ScalingPrediction& prediction : report.predictions) {
    ChartLine& line = lines.emplace_back();
    line.name = NameOf(prediction);
    line.color = SeriesColor(static_cast<int>(lines.size()) - 1);
    line.dashed = prediction.extrapolated;
    for (const ScalingPoint& point : prediction.points)
      line.points.push_back({point.workers, value(point)});
  }
  ChartLine marks{.name = absl::StrCat(CountText(report.panoramas), " panoramas, measured"),
                  .color = "var(--ink)",
                  .marks = true};
  for (const ScalingRun& run : report.runs) {
    if (run.panoramas == report.panoramas && measured(run) > 0.0)
      marks.points.push_back({run.workers, measured(run)});
  }
  if (!marks.points.empty()) lines.push_back(std::move(marks));
  return lines;
}

std::string WorkersCharts(const ScalingReport& report) {
  const std::vector<ChartLine> times = LinesOver(
      report,
      [](const ScalingPoint& point) { return point.wall_s; },
      [](const ScalingRun& run) { return run.wall_s; });
  const std::vector<ChartLine> efficiencies = LinesOver(
      report,
      [](const ScalingPoint& point) { return point.efficiency; },
      [](const ScalingRun& run) { return run.efficiency; });
  return "<div class=\"pair\">" +
         Section("Time",
                 "Of a whole job. Where a line is flat, the longest tasks and the serial stages "
                 "are what is left.",
                 LineChartSvg(times, {.x = "workers", .y = "wall clock, s"}) + LineKeyHtml(times)) +
         Section("Parallel efficiency",
                 "Time of one worker, over workers times the time of all.",
                 LineChartSvg(efficiencies, {.x = "workers", .y = "efficiency", .log_y = false}) +
                     LineKeyHtml(efficiencies)) +
         "</div>";
}

std::string WeakScaling(const ScalingReport& report) {
  if (report.weak.empty()) return "";
  ChartLine line{
      .name = absl::StrCat(CountText(report.panoramas), " panoramas per worker, simulated"),
      .color = SeriesColor(0)};
  std::string rows;
  for (const ScalingWeakPoint& point : report.weak) {
    line.points.push_back({static_cast<double>(point.workers), point.efficiency});
    absl::StrAppend(&rows,
                    "<tr><td>",
                    CountText(point.workers),
                    "</td><td>",
                    CountText(point.panoramas),
                    "</td><td>",
                    DurationText(point.wall_s),
                    "</td><td>",
                    DecimalText(100.0 * point.efficiency, 0),
                    " %</td></tr>");
  }
  const std::vector<ChartLine> lines = {line};
  return Section(
      "Weak scaling",
      "A street that grows with the number of workers. Efficiency: time of one worker on "
      "the measured job, over the time of all on theirs.",
      LineChartSvg(lines, {.x = "workers", .y = "efficiency", .log_y = false}) +
          LineKeyHtml(lines) +
          "<table><thead><tr><th>workers</th><th>panoramas</th><th>time</th>"
          "<th>efficiency</th></tr></thead><tbody>" +
          rows + "</tbody></table>");
}

/// One bar, divided by stage.
std::string ShareRow(const std::string& name,
                     const std::vector<double>& stage_s,
                     const std::vector<ScalingStage>& stages) {
  const double sum_s = std::accumulate(stage_s.begin(), stage_s.end(), 0.0);
  std::string bar;
  for (size_t s = 0; s < stage_s.size() && sum_s > 0.0; ++s) {
    absl::StrAppend(&bar,
                    "<div title=\"",
                    EscapeHtml(stages[s].name),
                    ": ",
                    DurationText(stage_s[s]),
                    "\" style=\"height:14px;width:",
                    DecimalText(100.0 * stage_s[s] / sum_s, 3),
                    "%;background:",
                    SeriesColor(static_cast<int>(s)),
                    "\"></div>");
  }
  return absl::StrCat("<tr><td>",
                      name,
                      "</td><td>",
                      DurationText(sum_s),
                      "</td><td style=\"width:70%\"><div style=\"display:flex\">",
                      bar,
                      "</div></td></tr>");
}

std::string StageKey(const std::vector<ScalingStage>& stages) {
  std::string key;
  for (size_t s = 0; s < stages.size(); ++s) {
    absl::StrAppend(&key,
                    "<span><i style=\"background:",
                    SeriesColor(static_cast<int>(s)),
                    "\"></i>",
                    EscapeHtml(stages[s].name),
                    "</span>");
  }
  return "<div class=\"key\">" + key + "</div>";
}

std::string Shares(const ScalingReport& report) {
  std::string html;
  for (const ScalingPrediction& prediction : report.predictions) {
    std::string rows;
    for (const ScalingPoint& point : prediction.points) {
      const uint32_t workers = point.workers;
      if (workers == 1 || workers == 10 || workers == 100 || workers == 1000)
        rows += ShareRow(CountText(workers) + (workers == 1 ? " worker" : " workers"),
                         point.stage_s,
                         report.stages);
    }
    rows += ShareRow("critical path", prediction.critical_stage_s, report.stages);
    absl::StrAppend(&html,
                    "<p class=\"sub\">",
                    NameOf(prediction),
                    "</p><table><tbody>",
                    rows,
                    "</tbody></table>");
  }
  return Section("Where the time goes",
                 "Each stage's part of the time, by the number of workers.",
                 html + StageKey(report.stages));
}

std::string Assumptions(const ScalingReport& report) {
  const ScalingAssumptions& assumed = report.assumptions;
  return Section(
      "How it is simulated",
      "Tasks take the CPU time that was measured; stages run one after the other, their tasks in "
      "order on the worker that is free first.",
      absl::StrCat("<ul><li>Bytes that a task reads and writes at ",
                   ShortText(assumed.worker_gbit_per_s),
                   " Gbit/s per worker; all together at no more than ",
                   ShortText(assumed.coordinator_gbit_per_s),
                   " Gbit/s (assumed).</li><li>",
                   ShortText(1e3 * assumed.task_overhead_s),
                   " ms of a worker per task beside it, ",
                   ShortText(1e3 * assumed.stage_overhead_s),
                   " ms between stages, ",
                   ShortText(1e3 * assumed.coordinator_s_per_task),
                   " ms of the coordinator per task (",
                   assumed.overhead_measured ? "measured" : "assumed",
                   ").</li><li>Extrapolated jobs repeat the measured tasks and scale them by the "
                   "growth found, linear growth at least; loops run as often as they "
                   "did.</li></ul>"));
}

std::string Cards(const ScalingReport& report) {
  std::string cards = Card(CountText(report.panoramas), "", "panoramas in the largest job");
  for (const ScalingPrediction& prediction : report.predictions) {
    cards +=
        Card(DurationText(prediction.critical_path_s), "", "critical path, " + NameOf(prediction));
  }
  return "<div class=\"cards\">" + cards + "</div>\n";
}

}  // namespace

std::string ScalingHtml(const ScalingReport& report) {
  return HtmlPage("Scaling - Orbweave",
                  absl::StrCat("<header><h1>Scaling of ",
                               EscapeHtml(report.title),
                               "</h1><p>Orbweave ",
                               EscapeHtml(report.version),
                               "</p></header>\n",
                               Cards(report),
                               report.study ? EngineStudyHtml(*report.study) : "",
                               WorkersCharts(report),
                               WeakScaling(report),
                               Shares(report),
                               ScalingStagesHtml(report),
                               ScalingRunsHtml(report),
                               Assumptions(report),
                               "<footer>All numbers of this page are in scaling.json.</footer>"));
}

}  // namespace orbweave
