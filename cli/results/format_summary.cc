// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/format_summary.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/io/first_names.h"
#include "core/io/page/group_messages.h"
#include "core/io/page/html_text.h"
#include "core/io/page/level_text.h"
#include "core/io/printable_text.h"

namespace orbweave {
namespace {

constexpr size_t kNamesShown = 3;
constexpr size_t kLinesShown = 12;  ///< of a kind; report.html has all

/// "; " and `whose`, how many positions are contradicted, and the first of them; empty: none.
std::string ContradictedText(const char* whose, const std::vector<std::string>& names) {
  if (names.empty()) return "";
  return absl::StrCat(
      "; ", whose, names.size(), " contradicted: ", PrintableText(FirstNames(names, kNamesShown)));
}

/// Positions that models other than the first contradict.
std::vector<std::string> OutliersOfOtherModels(const JobReport& report) {
  std::vector<std::string> names;
  for (size_t model = 1; model < report.each_model.size(); ++model)
    std::ranges::copy(report.each_model[model].gnss.outliers, std::back_inserter(names));
  return names;
}

std::string GnssLine(const JobReport& report) {
  const ReportGnss& gnss = report.gnss;
  if (!gnss.used) return gnss.reason.empty() ? "none" : "not used: " + PrintableText(gnss.reason);
  std::string line = absl::StrFormat("%u of %u positions agree, %.2f m RMS",
                                     gnss.num_inliers,
                                     gnss.num_priors,
                                     gnss.residual_rms_inliers_m);
  line += ContradictedText("", gnss.outliers);
  if (report.models > 1) {
    absl::StrAppend(&line,
                    " (model 0)",
                    ContradictedText("of the other models ", OutliersOfOtherModels(report)));
  }
  if (gnss.deformation_m == 0.0) return line;
  return line + absl::StrFormat("; the model was bent to them by up to %.1f m", gnss.deformation_m);
}

std::string SigmaLine(const JobReport& report) {
  const ReportUncertainty& uncertainty = report.uncertainty;
  if (!uncertainty.known) return "unknown: " + PrintableText(uncertainty.reason);
  return absl::StrCat(SigmaText(uncertainty.position_median),
                      report.gnss.used ? " m" : " units",
                      uncertainty.heights_are_known ? ", " : " along the ground, ",
                      SigmaText(uncertainty.rotation_median_deg),
                      " deg (median, ",
                      uncertainty.held_image.empty()
                          ? "absolute"
                          : "relative to " + PrintableText(uncertainty.held_image),
                      report.models > 1 ? "; model 0)" : ")");
}

/// Seams between clusters, and what is wrong with them.
std::string SeamsLine(const JobReport& report) {
  const auto count = [&](auto test) { return std::ranges::count_if(report.seams, test); };
  const auto is = [](SeamVerdict verdict) {
    return
        [verdict](const ReportSeam& seam) { return seam.used && seam.after.Verdict() == verdict; };
  };
  std::string line = absl::StrFormat("%u, %u seams", report.clusters.size(), report.seams.size());
  const std::pair<const char*, std::ptrdiff_t> faults[] = {
      {"switched off", count([](const ReportSeam& seam) { return !seam.used; })},
      {"bad", count(is(SeamVerdict::kBad))},
      {"doubtful", count(is(SeamVerdict::kDoubtful))},
      {"not certified", count(is(SeamVerdict::kUnknown))}};
  const char* separator = ": ";
  for (const auto& [what, number] : faults) {
    if (number == 0) continue;
    absl::StrAppend(&line, separator, number, " ", what);
    separator = ", ";
  }
  return line;
}

/// A line for each, the first few of them. `more`: what the rest is.
std::string Lines(const char* label, const std::vector<std::string>& lines, const char* more) {
  std::string text;
  for (size_t i = 0; i < std::min(lines.size(), kLinesShown); ++i)
    absl::StrAppendFormat(&text, "  %-11s %s\n", label, PrintableText(lines[i]));
  if (lines.size() > kLinesShown) {
    absl::StrAppendFormat(
        &text, "  %-11s %u more %s, see report.html\n", label, lines.size() - kLinesShown, more);
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

std::string FormatVerdict(const Verdict& verdict) {
  return Lines("unchecked", verdict.unchecked, "things") +
         absl::StrFormat("  %-11s %s\n", "verdict", LevelText(verdict.level)) +
         Lines("", verdict.reasons, "reasons");
}

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
  absl::StrAppend(&text, "  clusters    ", SeamsLine(report), "\n");
  absl::StrAppend(&text, "  GNSS        ", GnssLine(report), "\n");
  absl::StrAppend(&text, "  sigma       ", SigmaLine(report), "\n");
  text += Lines("left out", CountedLines(report.not_registered), "reasons");
  text += Lines("warning", CountedLines(report.warnings), "warnings");
  absl::StrAppend(&text, "\n", StageTable(report), "\n");
  absl::StrAppend(&text,
                  "  outputs     ",
                  output,
                  " (open report.html; sparse/0 in COLMAP; points.ply in CloudCompare)\n");
  return text + FormatVerdict(report.verdict);
}

}  // namespace orbweave
