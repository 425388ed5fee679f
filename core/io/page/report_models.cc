// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/page/report_models.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/io/page/html_page.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

constexpr size_t kMaxRows = 100;

std::string FrameText(const ReportGnss& gnss) {
  if (gnss.used) {
    return absl::StrCat("on earth: ",
                        CountText(gnss.num_inliers),
                        " of ",
                        CountText(gnss.num_priors),
                        " positions agree");
  }
  return gnss.reason.empty() ? "free" : "free: " + EscapeHtml(gnss.reason);
}

/// Median position sigma.
std::string PrecisionText(const ReportModel& model) {
  if (!model.uncertainty.known) return "-";
  return SigmaText(model.uncertainty.position_median) + (model.gnss.used ? " m" : " units");
}

std::string Row(size_t number, const ReportModel& model) {
  return absl::StrCat("<tr><td>",
                      number,
                      "</td><td>",
                      CountText(model.images),
                      "</td><td class=\"minor\">",
                      CountText(model.loose),
                      "</td><td class=\"minor\">",
                      CountText(model.points),
                      "</td><td class=\"minor\">",
                      CountText(model.observations),
                      "</td><td>",
                      DecimalText(model.residual_px_mean, 3),
                      "</td><td>",
                      PrecisionText(model),
                      "</td><td class=\"text\">",
                      FrameText(model.gnss),
                      "</td></tr>");
}

}  // namespace

std::string ModelsHtml(const JobReport& report) {
  const std::vector<ReportModel>& models = report.each_model;
  if (models.size() < 2) return "";
  std::string rows;
  for (size_t number = 0; number < std::min(models.size(), kMaxRows); ++number)
    rows += Row(number, models[number]);
  if (models.size() > kMaxRows) {
    absl::StrAppend(&rows,
                    "<tr><td class=\"text\" colspan=\"8\">and ",
                    CountText(models.size() - kMaxRows),
                    " smaller ones, all in report.json</td></tr>");
  }
  return Section("Models",
                 "Parts of the street that nothing joins: sparse/0, sparse/1, ... Those on earth "
                 "share one frame; a free one has a place and scale of its own.",
                 "<table><thead><tr><th>model</th><th>registered</th><th class=\"minor\">loose</th>"
                 "<th class=\"minor\">points</th><th class=\"minor\">observations</th><th>mean px"
                 "</th><th>median sigma</th><th class=\"text\">frame</th></tr></thead><tbody>" +
                     rows + "</tbody></table>");
}

}  // namespace orbweave
