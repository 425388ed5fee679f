// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/report_uncertainty.h"

#include "absl/strings/str_cat.h"
#include "core/io/html_text.h"

namespace orbweave {
namespace {

std::string Row(const std::string& what, double position, double rotation_deg) {
  return absl::StrCat("<tr><td class=\"text\">",
                      what,
                      "</td><td>",
                      SigmaText(position),
                      "</td><td>",
                      SigmaText(rotation_deg),
                      "</td></tr>");
}

}  // namespace

std::string UncertaintyFrameText(const ReportUncertainty& uncertainty) {
  if (!uncertainty.known) return "unknown: " + uncertainty.reason;
  if (uncertainty.held_image.empty()) {
    return "absolute: the frame is held by GNSS, whose errors count as independent from image to "
           "image";
  }
  std::string text = "relative to " + uncertainty.held_image + ", whose pose is held";
  if (uncertainty.held_distance_to.empty()) return text;
  return text + ", as is its distance to " + uncertainty.held_distance_to;
}

std::string UncertaintyHtml(const JobReport& report) {
  const ReportUncertainty& uncertainty = report.uncertainty;
  if (!uncertainty.known) return "";
  std::string rows = Row("median", uncertainty.position_median, uncertainty.rotation_median_deg) +
                     Row("95 % below", uncertainty.position_p95, uncertainty.rotation_p95_deg);
  for (const uint32_t index : uncertainty.worst) {
    const ReportImage& image = report.images[index];
    rows += Row(EscapeHtml(image.name),
                image.uncertainty->PositionSigma(),
                image.uncertainty->RotationSigma_deg());
  }
  std::string factors = "Bearings scatter " + ShortText(uncertainty.bearing_sigma_factor) +
                        " times as much as they claim";
  if (report.gnss.used) {
    absl::StrAppend(&factors,
                    ", GNSS positions ",
                    ShortText(uncertainty.horizontal_gnss_sigma_factor),
                    " times horizontally and ",
                    ShortText(uncertainty.vertical_gnss_sigma_factor),
                    " times vertically");
  }
  return absl::StrCat("<table><thead><tr><th>panorama</th><th>position, ",
                      report.gnss.used ? "m" : "units",
                      "</th><th>rotation, °</th></tr></thead><tbody>",
                      rows,
                      "</tbody></table><div class=\"key\"><span>",
                      factors,
                      "; the sigmas account for it.</span></div>");
}

}  // namespace orbweave
