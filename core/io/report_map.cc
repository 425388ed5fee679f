// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/report_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/io/html_text.h"
#include "core/io/map_view.h"
#include "core/io/report_seams.h"
#include "core/io/uncertainty_ellipses.h"

namespace orbweave {
namespace {

constexpr size_t kMaxDots = 3000;

MapImages ImagesOf(const JobReport& report, uint32_t model) {
  MapImages images;
  for (const ReportImage& image : report.images) {
    if (image.registered && image.model == model) images.push_back(&image);
  }
  return images;
}

std::string PairText(const Eigen::Vector2d& p) {
  return DecimalText(p.x(), 1) + "," + DecimalText(p.y(), 1);
}

/// A thin line per drive through its images.
std::string DriveLines(const MapImages& images, const MapView& view) {
  std::map<uint32_t, std::string> points;
  std::map<uint32_t, Eigen::Vector2d> last;
  for (const ReportImage* image : images) {
    const Eigen::Vector2d p = view.Page(image->centre_in_world);
    const auto [previous, is_first] = last.emplace(image->drive, p);
    if (!is_first && (p - previous->second).norm() < 0.7) continue;
    previous->second = p;
    absl::StrAppend(&points[image->drive], PairText(p), " ");
  }
  std::string svg;
  for (const auto& [drive, list] : points)
    absl::StrAppend(&svg, "<polyline class=\"path\" points=\"", list, "\"/>");
  return svg;
}

std::string UncertaintyText(const ReportImage& image) {
  if (!image.uncertainty) return "";
  return absl::StrCat("\nsigma ",
                      SigmaText(image.uncertainty->PositionSigma()),
                      ", ",
                      SigmaText(image.uncertainty->RotationSigma_deg()),
                      " deg");
}

std::string Dot(const ReportImage& image, const MapView& view, double radius) {
  const Eigen::Vector2d p = view.Page(image.centre_in_world);
  const std::string color = ClusterColor(image.cluster);
  return absl::StrCat("<circle cx=\"",
                      DecimalText(p.x(), 1),
                      "\" cy=\"",
                      DecimalText(p.y(), 1),
                      "\" r=\"",
                      DecimalText(image.in_overlap ? radius + 0.6 : radius, 1),
                      "\" ",
                      image.loose ? "fill=\"none\" stroke-width=\"2\" stroke=\"" + color + "\""
                                  : "fill=\"" + color + "\"",
                      image.in_overlap ? " class=\"overlap\"" : "",
                      "><title>",
                      EscapeHtml(image.name),
                      "\ncluster ",
                      image.cluster,
                      image.in_overlap ? ", in overlap" : "",
                      image.loose ? ", placed by GNSS only" : "",
                      "\n",
                      CountText(image.observations),
                      " observations, ",
                      DecimalText(image.residual_px_mean, 2),
                      " px",
                      UncertaintyText(image),
                      "</title></circle>");
}

std::string Dots(const MapImages& images, const MapView& view) {
  const size_t stride = (images.size() + kMaxDots - 1) / kMaxDots;
  const double radius = images.size() > 1000 ? 2.0 : images.size() > 200 ? 3.0 : 4.2;
  std::string svg;
  for (size_t i = 0; i < images.size(); i += stride) svg += Dot(*images[i], view, radius);
  return svg;
}

/// Dashes from a camera to the GNSS position that it contradicts.
std::string GnssOutliers(const MapImages& images, const MapView& view) {
  std::string svg;
  for (const ReportImage* image : images) {
    if (!image->gnss_outlier || !image->gnss_in_world) continue;
    const Eigen::Vector2d from = view.Page(image->centre_in_world);
    const Eigen::Vector2d to = view.Page(*image->gnss_in_world);
    absl::StrAppend(&svg,
                    "<path class=\"outlier\" d=\"M",
                    PairText(from),
                    "L",
                    PairText(to),
                    "m-4,-4l8,8m0,-8l-8,8\"><title>GNSS of ",
                    EscapeHtml(image->name),
                    " is contradicted by ",
                    ShortText((image->centre_in_world - *image->gnss_in_world).norm()),
                    " m</title></path>");
  }
  return svg;
}

/// Middle of the closest pair of images, one of each cluster.
std::optional<Eigen::Vector3d> SeamPlace(const std::map<int, MapImages>& by_cluster,
                                         const ReportSeam& seam) {
  const auto a = by_cluster.find(static_cast<int>(seam.cluster_a));
  const auto b = by_cluster.find(static_cast<int>(seam.cluster_b));
  if (a == by_cluster.end() || b == by_cluster.end()) return std::nullopt;
  double closest = std::numeric_limits<double>::infinity();
  Eigen::Vector3d middle(0, 0, 0);
  for (const ReportImage* x : a->second) {
    for (const ReportImage* y : b->second) {
      const double distance = (x->centre_in_world - y->centre_in_world).squaredNorm();
      if (distance >= closest) continue;
      closest = distance;
      middle = 0.5 * (x->centre_in_world + y->centre_in_world);
    }
  }
  return middle;
}

std::string Seams(const JobReport& report, const MapImages& images, const MapView& view) {
  std::map<int, MapImages> by_cluster;
  for (const ReportImage* image : images) by_cluster[image->cluster].push_back(image);
  std::string svg;
  const double r = report.seams.size() > 120 ? 3.0 : report.seams.size() > 40 ? 5.0 : 8.0;
  for (const ReportSeam& seam : report.seams) {
    const std::optional<Eigen::Vector3d> place = SeamPlace(by_cluster, seam);
    if (!place) continue;
    absl::StrAppend(&svg,
                    "<path class=\"seam",
                    seam.used ? " " + VerdictText(seam.after.Verdict()) : " unused",
                    "\" d=\"M",
                    PairText(view.Page(*place)),
                    "m0,",
                    -r,
                    "l",
                    r,
                    ",",
                    r,
                    "l",
                    -r,
                    ",",
                    r,
                    "l",
                    -r,
                    ",",
                    -r,
                    "z\"><title>seam ",
                    seam.cluster_a,
                    " - ",
                    seam.cluster_b,
                    "\n",
                    seam.common_images,
                    " common images, ",
                    CountText(seam.inlier_tracks),
                    " of ",
                    CountText(seam.common_tracks),
                    " common tracks agree",
                    seam.after.images == 0 ? ""
                                           : absl::StrCat("\nafter the adjustment ",
                                                          ShortText(seam.after.Ratio()),
                                                          " times the noise: ",
                                                          VerdictText(seam.after.Verdict())),
                    seam.used ? "" : "\nnot used: " + EscapeHtml(seam.reason),
                    "</title></path>");
  }
  return svg;
}

/// A bar of 1, 2 or 5 times a power of ten, about a fifth of the map.
std::string ScaleBar(const MapView& view, bool metric) {
  const double wanted = 0.2 * kMapWidth * view.units_per_pixel;
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  const double length = power * (wanted >= 5.0 * power ? 5.0 : wanted >= 2.0 * power ? 2.0 : 1.0);
  const double y = view.height - 16.0;
  const bool kilometres = metric && length >= 1000.0;
  return absl::StrCat("<path class=\"scale\" d=\"M20,",
                      DecimalText(y - 5, 1),
                      "v5h",
                      DecimalText(length / view.units_per_pixel, 1),
                      "v-5\"/><text x=\"26\" y=\"",
                      DecimalText(y - 6, 1),
                      "\">",
                      ShortText(kilometres ? length / 1000.0 : length),
                      metric ? (kilometres ? " km" : " m") : " units",
                      "</text>");
}

std::string NorthArrow() {
  return "<g transform=\"translate(966,44)\"><path class=\"north\" d=\"M0,-24l7,22l-7,-5l-7,5z\"/>"
         "<text text-anchor=\"middle\" y=\"16\">N</text></g>";
}

}  // namespace

std::string TrajectoryMapSvg(const JobReport& report, uint32_t model) {
  const MapImages images = ImagesOf(report, model);
  if (images.empty()) return "";
  const bool georeferenced = report.gnss.used;
  const MapView view = FitMapView(images, georeferenced);
  return absl::StrCat("<svg class=\"map\" viewBox=\"0 0 ",
                      kMapWidth,
                      " ",
                      DecimalText(view.height, 0),
                      "\" role=\"img\" aria-label=\"Trajectory from above\">",
                      DriveLines(images, view),
                      UncertaintyEllipses(images, view),
                      GnssOutliers(images, view),
                      Dots(images, view),
                      Seams(report, images, view),
                      images.size() > 1 ? ScaleBar(view, georeferenced) : "",
                      georeferenced && report.origin ? NorthArrow() : "",
                      "</svg>");
}

}  // namespace orbweave
