// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "bench/scaling/format_scaling.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "bench/scaling/engine_study_text.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

std::string RunsTable(const ScalingReport& report) {
  if (report.runs.empty()) return "";
  std::string text =
      "| panoramas | registered | workers | wall s | simulated s | efficiency | CPU s | CPU ms per "
      "panorama | coordinator, peak MB |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const ScalingRun& run : report.runs) {
    absl::StrAppendFormat(&text,
                          "| %s | %s | %u | %.2f | %.2f | %s | %.2f | %.1f | %.0f |\n",
                          CountText(run.panoramas),
                          CountText(run.registered),
                          run.workers,
                          run.wall_s,
                          run.simulated_s,
                          run.efficiency > 0.0 ? DecimalText(run.efficiency, 2) : "",
                          run.cpu_s,
                          1e3 * run.cpu_s / std::max(1U, run.panoramas),
                          static_cast<double>(run.coordinator_peak_bytes) / 1e6);
  }
  return text + "\n";
}

std::string StagesTable(const ScalingReport& report) {
  std::string text =
      absl::StrCat("Stages of ",
                   CountText(report.panoramas),
                   " panoramas:\n\n| stage | tasks | CPU s | growth | serial | kB in "
                   "/ panorama | kB out / panorama | worker, peak MB "
                   "|\n|---|---|---|---|---|---|---|---|\n");
  for (const ScalingStage& stage : report.stages) {
    absl::StrAppendFormat(&text,
                          "| %s | %u | %.2f | %s | %.1f %% | %s | %s | %.0f |\n",
                          stage.name,
                          stage.tasks,
                          stage.cpu_s,
                          stage.growth_exponent ? DecimalText(*stage.growth_exponent, 2) : "",
                          100.0 * stage.serial_share,
                          ShortText(stage.bytes_in_per_panorama / 1e3),
                          ShortText(stage.bytes_out_per_panorama / 1e3),
                          static_cast<double>(stage.peak_memory_bytes) / 1e6);
  }
  return text + "\n";
}

std::string PredictionsTable(const ScalingReport& report) {
  std::string text = "Simulated:\n\n| panoramas | critical path |";
  std::string rule = "|---|---|";
  const auto shown = [](const ScalingPoint& point) {
    return point.workers == 1 || point.workers == 10 || point.workers == 100 ||
           point.workers == 1000;
  };
  for (const ScalingPoint& point : report.predictions.front().points) {
    if (!shown(point)) continue;
    absl::StrAppend(
        &text, " ", CountText(point.workers), point.workers == 1 ? " worker |" : " workers |");
    rule += "---|";
  }
  absl::StrAppend(&text, "\n", rule, "\n");
  for (const ScalingPrediction& prediction : report.predictions) {
    absl::StrAppend(&text,
                    "| ",
                    CountText(prediction.panoramas),
                    prediction.extrapolated ? ", extrapolated" : "",
                    " | ",
                    DurationText(prediction.critical_path_s),
                    " |");
    for (const ScalingPoint& point : prediction.points) {
      if (!shown(point)) continue;
      absl::StrAppend(&text,
                      " ",
                      DurationText(point.wall_s),
                      " (",
                      DecimalText(100.0 * point.efficiency, 0),
                      " %) |");
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::string FormatScaling(const ScalingReport& report) {
  return (report.study ? FormatEngineStudy(*report.study) : "") + RunsTable(report) +
         StagesTable(report) + PredictionsTable(report);
}

}  // namespace orbweave
