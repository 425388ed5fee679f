// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/report_html.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/io/html_page.h"
#include "core/io/html_text.h"
#include "core/io/report_adjustment.h"
#include "core/io/report_charts.h"
#include "core/io/report_map.h"
#include "core/io/report_seams.h"
#include "core/io/report_tables.h"
#include "core/io/report_uncertainty.h"

namespace orbweave {
namespace {

constexpr size_t kMaxNames = 200;  ///< of contradicted positions; report.json has all
constexpr uint32_t kMaxMaps = 4;

std::string Header(const JobReport& report) {
  return absl::StrCat("<header><h1>",
                      EscapeHtml(report.title.empty() ? "Reconstruction" : report.title),
                      "</h1><p>Orbweave ",
                      EscapeHtml(report.version),
                      " · ",
                      DurationText(report.elapsed_s),
                      " on ",
                      report.workers.size(),
                      report.workers.size() == 1 ? " worker" : " workers",
                      "</p></header>\n");
}

/// Tiles are narrow: eight digits and more are shortened.
std::string CountCard(uint64_t count, const std::string& what) {
  if (count < 10'000'000) return Card(CountText(count), "", what);
  return Card(DecimalText(1e-6 * static_cast<double>(count), 1), "million", what);
}

std::string Cards(const JobReport& report) {
  std::string cards =
      absl::StrCat(Card(CountText(report.registered),
                        "of " + CountText(report.images_total),
                        "panoramas registered"),
                   CountCard(report.points, "points"),
                   CountCard(report.observations, "observations"),
                   Card(DecimalText(report.mean_track_length, 2), "images", "mean track length"),
                   Card(DecimalText(report.residual_px_mean, 3),
                        "px",
                        "mean residual (rms " + DecimalText(report.residual_px_rms, 3) + ")"),
                   Card(CountText(report.clusters.size()),
                        "",
                        report.clusters.size() == 1 ? "cluster" : "clusters"));
  if (report.models > 1) cards += Card(CountText(report.models), "", "separate models");
  if (report.gnss.used) {
    cards += Card(DecimalText(report.gnss.residual_median_m, 2),
                  "m",
                  absl::StrCat("median GNSS distance, ",
                               CountText(report.gnss.num_inliers),
                               " of ",
                               CountText(report.gnss.num_priors),
                               " agree"));
  }
  if (report.uncertainty.known) {
    cards += Card(SigmaText(report.uncertainty.position_median),
                  report.gnss.used ? "m" : "units",
                  "median position sigma (" + SigmaText(report.uncertainty.rotation_median_deg) +
                      "° of rotation)");
  }
  return "<div class=\"cards\">" + cards + "</div>\n";
}

std::string MapKey(const JobReport& report) {
  const auto any = [&](bool (*test)(const ReportImage&)) {
    return std::any_of(report.images.begin(), report.images.end(), test);
  };
  std::string key;
  const size_t shown = std::min<size_t>(report.clusters.size(), 12);
  for (size_t i = 0; i < shown; ++i) {
    absl::StrAppend(&key,
                    "<span><i style=\"background:",
                    ClusterColor(static_cast<int>(i)),
                    "\"></i>cluster ",
                    i,
                    "</span>");
  }
  if (report.clusters.size() > shown)
    absl::StrAppend(&key, "<span>and ", report.clusters.size() - shown, " more</span>");
  if (any([](const ReportImage& image) { return image.in_overlap; }))
    key += "<span><i class=\"ring\"></i>in two clusters or more</span>";
  if (any([](const ReportImage& image) { return image.loose; }))
    key += "<span><i class=\"hollow\"></i>placed by GNSS only</span>";
  if (!report.seams.empty())
    key +=
        "<span><i class=\"diamond\"></i>seam that fits</span><span><i class=\"diamond "
        "warn\"></i>doubtful</span><span><i class=\"diamond bad\"></i>bad or not used</span>";
  if (any([](const ReportImage& image) { return image.uncertainty.has_value(); }))
    key += "<span><i class=\"sigma\"></i>error ellipse, one sigma</span>";
  if (any([](const ReportImage& image) { return image.gnss_outlier; }))
    key += "<span><i class=\"dash\"></i>contradicted GNSS position</span>";
  return "<div class=\"key\">" + key + "</div>";
}

std::string Maps(const JobReport& report) {
  std::string maps;
  const uint32_t models = std::min(std::max(report.models, 1U), kMaxMaps);
  for (uint32_t model = 0; model < models; ++model) {
    const std::string map = TrajectoryMapSvg(report, model);
    if (map.empty()) continue;
    if (report.models > 1) absl::StrAppend(&maps, "<p class=\"sub\">model ", model, "</p>");
    maps += map;
  }
  if (maps.empty()) return Section("Trajectory", "No panorama could be placed.", "");
  const std::string frame =
      report.gnss.used
          ? "From above, north up, metres."
          : "From above, in a free frame and scale" +
                (report.gnss.reason.empty() ? "." : ": " + EscapeHtml(report.gnss.reason) + ".");
  return Section("Trajectory", frame, maps + MapKey(report));
}

std::string Charts(const JobReport& report) {
  if (report.observations == 0) return "";
  std::string charts = "<div class=\"pair\">";
  charts += Section("Residuals",
                    "Angle between bearing and point, in pixels at the equator.",
                    ResidualHistogramSvg(report));
  charts += Section(
      "Track lengths", "Points by the number of panoramas that see them.", TrackLengthSvg(report));
  charts += "</div>\n";
  return charts + Section("Tracks per image",
                          "Points that each panorama sees. A gap is a panorama without a place.",
                          TracksPerImageSvg(report));
}

std::string Times(const JobReport& report) {
  if (report.stages.empty()) return "";
  double cpu_s = 0.0;
  uint64_t reused = 0;
  for (const ReportStage& stage : report.stages) {
    cpu_s += stage.cpu_s;
    reused += stage.tasks_reused;
  }
  const std::string subtitle =
      absl::StrCat(DurationText(report.elapsed_s),
                   " in all, ",
                   DurationText(cpu_s),
                   " of CPU; ",
                   CountText(reused),
                   reused == 1 ? " task was found finished." : " tasks were found finished.");
  return Section("Time",
                 subtitle,
                 StageTimesHtml(report) +
                     "<div class=\"key\"><span><i class=\"wall\"></i>wall clock</span><span><i "
                     "class=\"cpu\"></i>CPU</span></div>");
}

std::string Seams(const JobReport& report) {
  const std::string table = SeamsHtml(report);
  if (table.empty()) return "";
  return Section(
      "Seams",
      "Where two clusters share panoramas. Jump: how far apart the two sides put them; "
      "before the global adjustment as reconstructed and aligned, after it by the points "
      "that panoramas of one side see and of the other. Good: less than three times what "
      "the noise of bearings explains.",
      table);
}

std::string Gnss(const JobReport& report) {
  const ReportGnss& gnss = report.gnss;
  if (gnss.num_priors == 0) return "";
  const std::string said =
      gnss.used
          ? absl::StrCat(CountText(gnss.num_inliers),
                         " of ",
                         CountText(gnss.num_priors),
                         " positions agree with the model; median distance ",
                         ShortText(gnss.residual_median_m),
                         " m, rms of those that agree ",
                         ShortText(gnss.residual_rms_inliers_m),
                         " m.",
                         gnss.bend_m > 0.0 ? absl::StrCat(" The model was bent to them by up to ",
                                                          ShortText(gnss.bend_m),
                                                          " m.")
                                           : "")
          : absl::StrCat(
                CountText(gnss.num_priors), " positions, not used: ", EscapeHtml(gnss.reason));
  std::string names;
  for (size_t i = 0; i < std::min(gnss.outliers.size(), kMaxNames); ++i)
    absl::StrAppend(&names, i == 0 ? "" : ", ", EscapeHtml(gnss.outliers[i]));
  return Section("GNSS",
                 said,
                 names.empty() ? ""
                               : absl::StrCat("<p class=\"warn\">",
                                              gnss.outliers.size(),
                                              " contradicted</p><p class=\"sub\">",
                                              names,
                                              "</p>"));
}

std::string Uncertainty(const JobReport& report) {
  if (report.images.empty()) return "";
  return Section("Uncertainty",
                 "One standard deviation of poses, " +
                     EscapeHtml(UncertaintyFrameText(report.uncertainty)) + ".",
                 UncertaintyHtml(report));
}

std::string Adjustment(const JobReport& report) {
  const std::string table = AdjustmentHtml(report);
  if (table.empty()) return "";
  return Section("Global adjustment",
                 "All poses and points of the first model at once; after each round observations "
                 "that do not fit are removed. Cost: half the sum of squared residuals in sigmas, "
                 "robust but in the last round.",
                 table);
}

std::string Options(const JobReport& report) {
  if (report.options_text.empty()) return "";
  return absl::StrCat("<section><details><summary>Options</summary><pre>",
                      EscapeHtml(report.options_text),
                      "</pre></details></section>\n");
}

}  // namespace

std::string ReportHtml(const JobReport& report) {
  return HtmlPage(
      report.title.empty() ? "Orbweave report" : report.title + " - Orbweave",
      absl::StrCat(
          Header(report),
          Cards(report),
          Maps(report),
          Charts(report),
          Times(report),
          ClustersHtml(report),
          Seams(report),
          Adjustment(report),
          Gnss(report),
          Uncertainty(report),
          LeftOutHtml(report),
          WarningsHtml(report),
          WorkersHtml(report),
          Options(report),
          "<footer>Residuals are angles times width over 2π. All numbers of this page are in "
          "report.json.</footer>"));
}

}  // namespace orbweave
