// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/report_uncertainty.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

/// A share of a length, in words that fit its size.
std::string ShareText(double share) {
  if (!std::isfinite(share)) return "-";
  return share < 1e-3 ? SigmaText(1e6 * share) + " ppm" : SigmaText(100.0 * share) + " %";
}

/// `step`: the median distance of neighbours; 0: unknown.
std::string Row(const std::string& what, double position, double rotation_deg, double step) {
  return absl::StrCat("<tr><td class=\"text\">",
                      what,
                      "</td><td>",
                      SigmaText(position),
                      "</td><td>",
                      step > 0.0 ? ShareText(position / step) : "-",
                      "</td><td>",
                      SigmaText(rotation_deg),
                      "</td></tr>");
}

}  // namespace

std::string UncertaintyFrameText(const ReportUncertainty& uncertainty) {
  if (!uncertainty.known) return "unknown: " + uncertainty.reason;
  if (uncertainty.held_image.empty()) {
    return absl::StrCat(
        "absolute: the frame is held by GNSS, whose errors count as alike as they are found along "
        "the street; an offset that all positions share shows nowhere, and is not in it",
        uncertainty.heights_are_known
            ? ""
            : "; no position has a height: those of the model are known but for a shift");
  }
  std::string text = "relative to " + uncertainty.held_image + ", whose pose is held";
  if (uncertainty.held_distance_to.empty()) return text;
  return text + ", as is its distance to " + uncertainty.held_distance_to;
}

std::string RelativePrecisionText(const JobReport& report) {
  if (!report.uncertainty.known || report.each_model.empty()) return "";
  const ReportModel& model = report.each_model.front();
  const double median = report.uncertainty.position_median;
  const std::string unit = report.gnss.used ? " m" : " units";
  std::string text;
  if (model.path_length > 0.0 && model.is_in_order) {
    text = absl::StrCat(ShareText(median / model.path_length),
                        " of a path of ",
                        ShortText(model.path_length),
                        unit);
  }
  if (!(model.step_median > 0.0)) return text;
  return absl::StrCat(text,
                      text.empty() ? "" : ", ",
                      ShareText(median / model.step_median),
                      " of ",
                      model.is_in_order ? "a step of " : "the distance to the nearest panorama, ",
                      ShortText(model.step_median),
                      unit);
}

std::string UncertaintyHtml(const JobReport& report) {
  const ReportUncertainty& uncertainty = report.uncertainty;
  if (!uncertainty.known) return "";
  const double step = report.each_model.empty() ? 0.0 : report.each_model.front().step_median;
  const bool is_in_order = report.each_model.empty() || report.each_model.front().is_in_order;
  std::string rows =
      Row("median", uncertainty.position_median, uncertainty.rotation_median_deg, step) +
      Row("95 % below", uncertainty.position_p95, uncertainty.rotation_p95_deg, step);
  for (const uint32_t index : uncertainty.worst) {
    const ReportImage& image = report.images[index];
    rows += Row(EscapeHtml(image.name),
                uncertainty.PositionSigma(*image.uncertainty),
                image.uncertainty->RotationSigma_deg(),
                step);
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
  const std::string relative = RelativePrecisionText(report);
  return absl::StrCat(
      "<table><thead><tr><th>panorama</th><th>position",
      uncertainty.heights_are_known ? ", " : " along the ground, ",
      report.gnss.used ? "m" : "units",
      "</th><th>",
      is_in_order ? "of a step" : "of the distance to the nearest",
      "</th><th>rotation, °</th></tr></thead><tbody>",
      rows,
      "</tbody></table><div class=\"key\"><span>",
      factors,
      "; the sigmas account for it.</span>",
      relative.empty() ? "" : "<span>Median position sigma: " + relative + ".</span>",
      "</div>");
}

}  // namespace orbweave
