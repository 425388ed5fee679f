// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/report_html.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/io/page/html_page.h"
#include "core/io/page/html_text.h"
#include "core/io/page/report_adjustment.h"
#include "core/io/page/report_charts.h"
#include "core/io/page/report_gnss.h"
#include "core/io/page/report_map.h"
#include "core/io/page/report_models.h"
#include "core/io/page/report_seams.h"
#include "core/io/page/report_tables.h"
#include "core/io/page/report_uncertainty.h"
#include "core/io/page/report_verdict.h"

namespace orbweave {
namespace {

constexpr size_t kMaxMaps = 4;

/// Empty for a job whose results were all found finished.
std::string WorkersText(size_t workers) {
  if (workers == 0) return "";
  return absl::StrCat(" on ", workers, workers == 1 ? " worker" : " workers");
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
                        "mean residual (rms " + DecimalText(report.residual_px_rms, 3) +
                            "; in the image " + DecimalText(report.residual_erp_px_mean, 3) + ")"),
                   Card(CountText(report.clusters.size()),
                        "",
                        report.clusters.size() == 1 ? "cluster" : "clusters"));
  const std::string of_model = report.models > 1 ? " in model 0" : "";
  if (report.models > 1) cards += Card(CountText(report.models), "", "separate models");
  if (report.gnss.used) {
    cards += Card(DecimalText(report.gnss.residual_median_m, 2),
                  "m",
                  absl::StrCat("median GNSS distance, ",
                               CountText(report.gnss.num_inliers),
                               " of ",
                               CountText(report.gnss.num_priors),
                               " agree",
                               of_model));
  }
  if (report.uncertainty.known) {
    const std::string relative = RelativePrecisionText(report);
    cards += Card(SigmaText(report.uncertainty.position_median),
                  report.gnss.used ? "m" : "units",
                  absl::StrCat("median position sigma",
                               report.uncertainty.heights_are_known ? "" : " along the ground",
                               relative.empty() ? "" : ": ",
                               relative,
                               "; ",
                               SigmaText(report.uncertainty.rotation_median_deg),
                               "° of rotation",
                               of_model));
  }
  return "<div class=\"cards\">" + cards + "</div>\n";
}

/// How a frame lies, and which models share it.
std::string FrameText(const JobReport& report, const MapFrame& frame) {
  const ReportGnss& gnss = report.each_model[frame.models.front()].gnss;
  std::string text;
  if (report.models > 1) {
    text = frame.models.size() == 1
               ? absl::StrCat("Model ", frame.models.front(), ". ")
               : absl::StrCat(frame.models.size(), " models that GNSS puts into one frame. ");
  }
  if (frame.georeferenced) return text + "From above, north up, metres.";
  return text + "From above, in a free frame and scale" +
         (gnss.reason.empty() ? "." : ": " + EscapeHtml(gnss.reason) + ".");
}

std::string Maps(const JobReport& report) {
  const std::vector<MapFrame> frames = MapFrames(report);
  std::string maps;
  for (size_t i = 0; i < std::min(frames.size(), kMaxMaps); ++i) {
    const std::string map = TrajectoryMapSvg(report, frames[i]);
    if (map.empty()) continue;
    absl::StrAppend(&maps,
                    "<p class=\"sub\">",
                    FrameText(report, frames[i]),
                    "</p>",
                    map,
                    MapKeyHtml(report, frames[i], map));
  }
  if (maps.empty()) return Section("Trajectory", "No panorama could be placed.", "");
  if (frames.size() > kMaxMaps) {
    absl::StrAppend(&maps,
                    "<p class=\"sub\">",
                    CountText(frames.size() - kMaxMaps),
                    " smaller models are not drawn.</p>");
  }
  return "<section><h2>Trajectory</h2>" + maps + "</section>\n";
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

std::string Uncertainty(const JobReport& report) {
  if (report.images.empty()) return "";
  return Section(
      "Uncertainty",
      absl::StrCat(
          "One standard deviation of poses", report.models > 1 ? " of model 0" : "", ", ") +
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
          PageHead(report.title.empty() ? "Reconstruction" : report.title,
                   report.version,
                   DurationText(report.elapsed_s) + WorkersText(report.workers.size())),
          VerdictHtml(report),
          WarningsHtml(report),
          Cards(report),
          Maps(report),
          ChecksHtml(report),
          LeftOutHtml(report),
          ModelsHtml(report),
          GnssHtml(report),
          Uncertainty(report),
          Charts(report),
          PairsHtml(report),
          ClustersHtml(report),
          Seams(report),
          Adjustment(report),
          TimesHtml(report.elapsed_s, report.stages),
          WorkersHtml(report),
          Options(report),
          "<footer>Residuals are angles times width over 2π. All numbers of this page are in "
          "report.json.</footer>"));
}

}  // namespace orbweave
