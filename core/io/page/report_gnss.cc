// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/page/report_gnss.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/io/page/html_page.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

constexpr size_t kMaxRows = 200;

double DistanceOf(const ReportImage& image) {
  return (*image.gnss_in_world - image.centre_in_world).norm();
}

std::string SummaryOf(const ReportGnss& gnss) {
  if (!gnss.used)
    return absl::StrCat(
        CountText(gnss.num_priors), " positions, not used: ", EscapeHtml(gnss.reason));
  return absl::StrCat(
      CountText(gnss.num_inliers),
      " of ",
      CountText(gnss.num_priors),
      " positions agree with the model; median distance ",
      ShortText(gnss.residual_median_m),
      " m, rms of those that agree ",
      ShortText(gnss.residual_rms_inliers_m),
      " m.",
      gnss.deformation_m > 0.0
          ? absl::StrCat(
                " The model was bent to them by up to ", ShortText(gnss.deformation_m), " m.")
          : "");
}

std::string Row(const ReportImage& image) {
  const Eigen::Vector3d off_m = *image.gnss_in_world - image.centre_in_world;
  std::string row = absl::StrCat("<tr><td class=\"text\">", EscapeHtml(image.name), "</td>");
  for (const double value : {off_m.x(), off_m.y(), off_m.z(), off_m.norm()})
    absl::StrAppend(&row, "<td>", ShortText(value), "</td>");
  return row + "</tr>";
}

std::string ContradictedHtml(const JobReport& report) {
  const std::vector<const ReportImage*> images = ContradictedPositions(report);
  if (images.empty()) return "";
  std::string rows;
  for (size_t i = 0; i < std::min(images.size(), kMaxRows); ++i) rows += Row(*images[i]);
  if (images.size() > kMaxRows) {
    absl::StrAppend(&rows,
                    "<tr><td class=\"text\" colspan=\"5\">and ",
                    CountText(images.size() - kMaxRows),
                    " nearer ones, all in report.json</td></tr>");
  }
  return absl::StrCat("<p class=\"warn\">",
                      CountText(images.size()),
                      images.size() == 1 ? " contradicted position" : " contradicted positions",
                      ", GNSS minus model in metres:</p><table><thead><tr><th>panorama</th><th>E"
                      "</th><th>N</th><th>U</th><th>distance</th></tr></thead><tbody>",
                      rows,
                      "</tbody></table>");
}

}  // namespace

std::vector<const ReportImage*> ContradictedPositions(const JobReport& report) {
  std::vector<const ReportImage*> images;
  for (const ReportImage& image : report.images) {
    if (image.registered && image.gnss_outlier && image.gnss_in_world) images.push_back(&image);
  }
  std::ranges::stable_sort(images, [](const ReportImage* x, const ReportImage* y) {
    return DistanceOf(*x) > DistanceOf(*y);
  });
  return images;
}

std::string GnssHtml(const JobReport& report) {
  const std::string contradicted = ContradictedHtml(report);
  if (report.gnss.num_priors == 0 && contradicted.empty()) return "";
  const char* model = report.models > 1 ? "Model 0: " : "";
  return Section("GNSS", model + SummaryOf(report.gnss), contradicted);
}

}  // namespace orbweave
