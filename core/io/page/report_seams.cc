// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/report_seams.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

constexpr size_t kMaxRows = 300;
constexpr double kCmPerM = 100.0;
constexpr double kMilli = 1000.0;

std::string Cell(const std::string& text) { return "<td>" + text + "</td>"; }
/// One that narrow pages leave out.
std::string MinorCell(const std::string& text) { return "<td class=\"minor\">" + text + "</td>"; }

/// Position and rotation, in the units of the table's head.
std::string JumpCells(double position, double rotation_deg, bool metric, bool after) {
  const std::string jump = ShortText(metric ? kCmPerM * position : position);
  return (after ? Cell(jump) : MinorCell(jump)) + MinorCell(ShortText(kMilli * rotation_deg));
}

std::string StateCell(const ReportSeam& seam) {
  if (!seam.used) return "<td class=\"text bad\">not used: " + EscapeHtml(seam.reason) + "</td>";
  const SeamVerdict verdict = seam.after.Verdict();
  const std::string style = verdict == SeamVerdict::kGood       ? " good"
                            : verdict == SeamVerdict::kDoubtful ? " warn"
                            : verdict == SeamVerdict::kBad      ? " bad"
                                                                : "";
  const std::string ratio =
      verdict == SeamVerdict::kUnknown
          ? ""
          : absl::StrCat(": ", ShortText(seam.after.Ratio()), " times the noise");
  return "<td class=\"text" + style + "\">" + VerdictText(verdict) + ratio + "</td>";
}

std::string Row(const ReportSeam& seam, bool metric) {
  std::string row = absl::StrCat("<tr><td>", seam.cluster_a, " - ", seam.cluster_b, "</td>");
  row += MinorCell(CountText(seam.common_images));
  row +=
      MinorCell(absl::StrCat(CountText(seam.inlier_tracks), " of ", CountText(seam.common_tracks)));
  row += MinorCell(ShortText(seam.condition_number));
  row += JumpCells(seam.position_jump_m, seam.rotation_jump_deg, metric, false);
  row += seam.after.images > 0
             ? JumpCells(seam.after.position_jump_m, seam.after.rotation_jump_deg, metric, true)
             : Cell("") + MinorCell("");
  return row + StateCell(seam) + "</tr>";
}

}  // namespace

std::string VerdictText(SeamVerdict verdict) {
  switch (verdict) {
    case SeamVerdict::kGood:
      return "good";
    case SeamVerdict::kDoubtful:
      return "doubtful";
    case SeamVerdict::kBad:
      return "bad";
    case SeamVerdict::kUnknown:
      break;
  }
  return "unknown";
}

std::string SeamsHtml(const JobReport& report) {
  if (report.seams.empty()) return "";
  // The worst first.
  std::vector<const ReportSeam*> seams;
  for (const ReportSeam& seam : report.seams) seams.push_back(&seam);
  std::stable_sort(seams.begin(), seams.end(), [](const ReportSeam* x, const ReportSeam* y) {
    return std::pair(x->used, -x->after.Ratio()) < std::pair(y->used, -y->after.Ratio());
  });
  const std::string unit = report.gnss.used ? "cm" : "units";
  std::string html = absl::StrCat(
      "<table><thead><tr><th>clusters</th><th class=\"minor\">images</th><th "
      "class=\"minor\">tracks "
      "that agree</th><th class=\"minor\">condition</th><th class=\"minor\">jump before, ",
      unit,
      "</th><th class=\"minor\">m°</th><th>after, ",
      unit,
      "</th><th class=\"minor\">m°</th><th class=\"text\"></th></tr></thead><tbody>");
  for (size_t i = 0; i < std::min(seams.size(), kMaxRows); ++i)
    html += Row(*seams[i], report.gnss.used);
  html += "</tbody></table>";
  if (seams.size() > kMaxRows)
    absl::StrAppend(&html, "<p class=\"sub\">and ", seams.size() - kMaxRows, " better ones</p>");
  return html;
}

}  // namespace orbweave
