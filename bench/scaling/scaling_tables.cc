// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/scaling_tables.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/io/page/html_page.h"
#include "core/io/page/html_text.h"

namespace orbweave {

std::string ScalingStagesHtml(const ScalingReport& report) {
  std::string rows;
  for (const ScalingStage& stage : report.stages) {
    absl::StrAppend(&rows,
                    "<tr><td class=\"text\">",
                    EscapeHtml(stage.name),
                    "</td><td>",
                    CountText(stage.tasks),
                    "</td><td>",
                    CountText(stage.runs),
                    "</td><td>",
                    DecimalText(stage.cpu_s, 2),
                    "</td><td>",
                    stage.growth_exponent ? DecimalText(*stage.growth_exponent, 2) : "-",
                    "</td><td>",
                    DecimalText(100.0 * stage.serial_share, 1),
                    " %</td><td>",
                    ShortText(stage.bytes_in_per_panorama / 1e3),
                    "</td><td>",
                    ShortText(stage.bytes_out_per_panorama / 1e3),
                    "</td><td>",
                    ShortText(static_cast<double>(stage.peak_memory_bytes) / 1e6),
                    "</td></tr>");
  }
  return Section(
      "Stages",
      absl::StrCat("Of the largest job that was run, ",
                   CountText(report.panoramas),
                   " panoramas. Growth: exponent of CPU time over panoramas. Serial: the "
                   "longest task of each run over all tasks."),
      "<table><thead><tr><th>stage</th><th>tasks</th><th>runs</th><th>CPU "
      "s</th><th>growth</th><th>serial</th><th>kB in / panorama</th><th>kB out / "
      "panorama</th><th>peak MB of a worker</th></tr></thead><tbody>" +
          rows + "</tbody></table>");
}

std::string ScalingRunsHtml(const ScalingReport& report) {
  if (report.runs.empty()) return "";
  std::string rows;
  for (const ScalingRun& run : report.runs) {
    absl::StrAppend(&rows,
                    "<tr><td>",
                    CountText(run.panoramas),
                    "</td><td>",
                    CountText(run.registered),
                    "</td><td>",
                    run.workers,
                    "</td><td>",
                    DecimalText(run.wall_s, 2),
                    "</td><td>",
                    DecimalText(run.simulated_s, 2),
                    "</td><td>",
                    run.efficiency > 0.0 ? DecimalText(run.efficiency, 2) : "-",
                    "</td><td>",
                    DecimalText(run.cpu_s, 2),
                    "</td><td>",
                    DecimalText(1e3 * run.cpu_s / std::max(1U, run.panoramas), 1),
                    "</td><td>",
                    DecimalText(run.residual_px_rms, 3),
                    "</td><td>",
                    ShortText(static_cast<double>(run.coordinator_peak_bytes) / 1e6),
                    "</td></tr>");
  }
  return Section("Runs",
                 absl::StrCat("Jobs that were really run, on ",
                              report.processors,
                              " processors with a load average of ",
                              DecimalText(report.load_average, 1),
                              " before; a load beside the jobs makes the wall clock long, and CPU "
                              "time little."),
                 "<table><thead><tr><th>panoramas</th><th>registered</th><th>workers</th><th>wall "
                 "s</th><th>simulated s</th><th>efficiency</th><th>CPU s</th><th>CPU ms / "
                 "panorama</th><th>rms px</th><th>peak MB of the "
                 "coordinator</th></tr></thead><tbody>" +
                     rows + "</tbody></table>");
}

}  // namespace orbweave
