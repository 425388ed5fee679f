// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/format_summary.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/io/html_text.h"
#include "core/io/printable_text.h"

namespace orbweave {
namespace {

constexpr size_t kNamesShown = 5;

std::string GnssLine(const ReportGnss& gnss) {
  if (!gnss.used) return gnss.reason.empty() ? "none" : "not used: " + PrintableText(gnss.reason);
  const std::string agreement = absl::StrFormat("%u of %u positions agree, %.2f m RMS",
                                                gnss.num_inliers,
                                                gnss.num_priors,
                                                gnss.residual_rms_inliers_m);
  if (gnss.bend_m == 0.0) return agreement;
  return agreement + absl::StrFormat("; the model was bent to them by up to %.1f m", gnss.bend_m);
}

std::string SigmaLine(const JobReport& report) {
  const ReportUncertainty& uncertainty = report.uncertainty;
  if (!uncertainty.known) return "unknown: " + PrintableText(uncertainty.reason);
  return absl::StrCat(SigmaText(uncertainty.position_median),
                      report.gnss.used ? " m" : " units",
                      ", ",
                      SigmaText(uncertainty.rotation_median_deg),
                      " deg (median, ",
                      uncertainty.held_image.empty()
                          ? "absolute"
                          : "relative to " + PrintableText(uncertainty.held_image),
                      ")");
}

std::string LeftOut(const JobReport& report) {
  std::string text;
  for (size_t i = 0; i < report.not_registered.size() && i < kNamesShown; ++i) {
    absl::StrAppend(&text,
                    "  left out    ",
                    PrintableText(report.not_registered[i].name),
                    ": ",
                    PrintableText(report.not_registered[i].reason),
                    "\n");
  }
  if (report.not_registered.size() > kNamesShown) {
    absl::StrAppend(&text,
                    "  left out    ",
                    report.not_registered.size() - kNamesShown,
                    " more, see report.html\n");
  }
  return text;
}

std::string StageTable(const JobReport& report) {
  std::string text = absl::StrFormat(
      "  %-22s %10s %10s %9s %8s\n", "stage", "wall s", "CPU s", "computed", "reused");
  for (const ReportStage& stage : report.stages) {
    absl::StrAppendFormat(&text,
                          "  %-22s %10.1f %10.1f %9u %8u\n",
                          stage.name,
                          stage.wall_s,
                          stage.cpu_s,
                          stage.tasks_computed,
                          stage.tasks_reused);
  }
  return text;
}

}  // namespace

std::string FormatSummary(const JobReport& report, const std::string& output) {
  std::string text;
  absl::StrAppendFormat(&text,
                        "  registered  %u of %u images in %u model%s\n",
                        report.registered,
                        report.images_total,
                        report.models,
                        report.models == 1 ? "" : "s");
  absl::StrAppendFormat(
      &text, "  points      %u, mean track length %.2f\n", report.points, report.mean_track_length);
  absl::StrAppendFormat(&text,
                        "  residual    %.3f px mean, %.3f px RMS\n",
                        report.residual_px_mean,
                        report.residual_px_rms);
  absl::StrAppendFormat(
      &text, "  clusters    %u, %u seams\n", report.clusters.size(), report.seams.size());
  absl::StrAppend(&text, "  GNSS        ", GnssLine(report.gnss), "\n");
  absl::StrAppend(&text, "  sigma       ", SigmaLine(report), "\n");
  absl::StrAppend(&text, LeftOut(report));
  for (const std::string& warning : report.warnings)
    absl::StrAppend(&text, "  warning     ", PrintableText(warning), "\n");
  absl::StrAppend(&text, "\n", StageTable(report), "\n");
  absl::StrAppend(&text,
                  "  outputs     ",
                  output,
                  " (open report.html; sparse/0 in COLMAP; points.ply in CloudCompare)\n");
  return text;
}

}  // namespace orbweave
