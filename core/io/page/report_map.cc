// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/report_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/io/page/cluster_colors.h"
#include "core/io/page/html_text.h"
#include "core/io/page/map_symbols.h"
#include "core/io/page/map_view.h"
#include "core/io/page/report_seams.h"
#include "core/io/page/uncertainty_ellipses.h"

namespace orbweave {
namespace {

constexpr size_t kMaxDots = 3000;
constexpr size_t kFewDots = 100;   ///< more are drawn smaller on narrow pages
constexpr size_t kMaxMarks = 500;  ///< of images without a pose, and of contradicted positions

MapImages ImagesOf(const JobReport& report, const MapFrame& frame) {
  MapImages images;
  for (const ReportImage& image : report.images) {
    if (image.registered && std::ranges::binary_search(frame.models, image.model))
      images.push_back(&image);
  }
  return images;
}

/// Images without a pose that have a place on the map by GNSS.
MapImages MissingImages(const JobReport& report, const MapFrame& frame) {
  MapImages images;
  if (!frame.georeferenced) return images;
  for (const ReportImage& image : report.images) {
    if (!image.registered && image.gnss_in_world) images.push_back(&image);
  }
  return images;
}

MapImages ContradictedImages(const MapImages& images) {
  MapImages contradicted;
  std::ranges::copy_if(images, std::back_inserter(contradicted), [](const ReportImage* image) {
    return image->gnss_outlier && image->gnss_in_world;
  });
  return contradicted;
}

/// Those of them that are drawn.
MapImages FirstMarks(MapImages images) {
  if (images.size() > kMaxMarks) images.resize(kMaxMarks);
  return images;
}

/// Every how manieth of so many images is drawn.
size_t StrideOf(size_t num_images) { return (num_images + kMaxDots - 1) / kMaxDots; }

/// The colour of an image: its model's where the frame has several, else its cluster's.
class MapColors {
 public:
  MapColors(const JobReport& report, const MapFrame& frame)
      : frame_(frame), of_cluster_(ColorsOfClusters(report)) {}

  [[nodiscard]] std::string ClassOf(const ReportImage& image) const {
    if (frame_.models.size() > 1) return ColorClass(OfModel(image.model));
    const bool known = image.cluster >= 0 && std::cmp_less(image.cluster, of_cluster_.size());
    return ColorClass(known ? of_cluster_[static_cast<size_t>(image.cluster)] : -1);
  }
  /// Models of a frame take colours in turn.
  [[nodiscard]] int OfModel(uint32_t model) const {
    return static_cast<int>(std::ranges::lower_bound(frame_.models, model) - frame_.models.begin());
  }

 private:
  const MapFrame& frame_;
  std::vector<int> of_cluster_;
};

std::string PairText(const Eigen::Vector2d& p) {
  return DecimalText(p.x(), 1) + "," + DecimalText(p.y(), 1);
}

/// A thin line per path of the frame's models.
std::string PathLines(const JobReport& report, const MapFrame& frame, const MapView& view) {
  constexpr double kShortest_px = 0.7;
  std::string svg;
  for (const ReportPath& path : report.paths) {
    if (!std::ranges::binary_search(frame.models, path.model)) continue;
    std::string points;
    Eigen::Vector2d last = Eigen::Vector2d::Zero();
    for (const uint32_t image : path.images) {
      const Eigen::Vector2d p = view.Page(report.images[image].centre_in_world);
      const bool is_end = image == path.images.front() || image == path.images.back();
      if (!is_end && (p - last).norm() < kShortest_px) continue;
      last = p;
      absl::StrAppend(&points, PairText(p), " ");
    }
    absl::StrAppend(&svg, "<polyline class=\"path\" points=\"", points, "\"/>");
  }
  return svg;
}

std::string UncertaintyText(const JobReport& report, const ReportImage& image) {
  if (!image.uncertainty) return "";
  const ReportUncertainty& of_model = image.model < report.each_model.size()
                                          ? report.each_model[image.model].uncertainty
                                          : report.uncertainty;
  return absl::StrCat("\nsigma ",
                      SigmaText(of_model.PositionSigma(*image.uncertainty)),
                      of_model.heights_are_known ? "" : " along the ground",
                      ", ",
                      SigmaText(image.uncertainty->RotationSigma_deg()),
                      " deg");
}

std::string TitleOf(const JobReport& report, const ReportImage& image) {
  std::string title = EscapeHtml(image.name) + "\n";
  if (report.models > 1) absl::StrAppend(&title, "model ", image.model, ", ");
  absl::StrAppend(&title,
                  image.cluster < 0 ? "no cluster" : absl::StrCat("cluster ", image.cluster),
                  image.in_overlap ? ", in overlap" : "");
  if (image.loose) return title + "\nplaced loosely, not registered";
  return absl::StrCat(title,
                      "\n",
                      CountText(image.observations),
                      " observations, ",
                      DecimalText(image.residual_px_mean, 2),
                      " px",
                      UncertaintyText(report, image));
}

std::string Dots(const JobReport& report,
                 const MapImages& images,
                 const MapColors& colors,
                 const MapView& view) {
  const size_t stride = StrideOf(images.size());
  const double radius = images.size() > 1000 ? 2.0 : images.size() > 200 ? 3.0 : 4.2;
  std::string svg;
  for (size_t i = 0; i < images.size(); i += stride) {
    const ReportImage& image = *images[i];
    const Eigen::Vector2d p = view.Page(image.centre_in_world);
    const std::string title = TitleOf(report, image);
    if (image.loose) {
      svg += DrawnSymbol(MapSymbol::kLoose, p, radius, colors.ClassOf(image), title);
      continue;
    }
    absl::StrAppend(&svg,
                    "<circle class=\"",
                    image.in_overlap ? SymbolClass(MapSymbol::kOverlap) : "dot",
                    " ",
                    colors.ClassOf(image),
                    "\" cx=\"",
                    DecimalText(p.x(), 1),
                    "\" cy=\"",
                    DecimalText(p.y(), 1),
                    "\" r=\"",
                    DecimalText(radius, 1),
                    "\"><title>",
                    title,
                    "</title></circle>");
  }
  return svg;
}

Eigen::Vector2d MiddleOf(const MapView& view) { return {0.5 * kMapWidth, 0.5 * view.height}; }

std::string Missing(const MapImages& missing, const MapView& view) {
  std::string svg;
  for (const ReportImage* image : missing) {
    const Eigen::Vector2d place =
        WithinFrame(view, MiddleOf(view), view.Page(*image->gnss_in_world));
    svg += DrawnSymbol(MapSymbol::kMissing,
                       place,
                       5.0,
                       "",
                       EscapeHtml(image->name) + "\nnot registered, at its GNSS position");
  }
  return svg;
}

/// Dashes from a camera to the GNSS position that it contradicts.
std::string GnssOutliers(const MapImages& contradicted, const MapView& view) {
  std::string svg;
  for (const ReportImage* image : contradicted) {
    const Eigen::Vector2d from = view.Page(image->centre_in_world);
    const Eigen::Vector2d to = WithinFrame(view, from, view.Page(*image->gnss_in_world));
    absl::StrAppend(&svg, "<path class=\"dash\" d=\"M", PairText(from), "L", PairText(to), "\"/>");
    svg +=
        DrawnSymbol(MapSymbol::kContradicted,
                    to,
                    4.0,
                    "",
                    absl::StrCat("GNSS of ",
                                 EscapeHtml(image->name),
                                 " is contradicted by ",
                                 ShortText((image->centre_in_world - *image->gnss_in_world).norm()),
                                 " m"));
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

MapSymbol SymbolOf(const ReportSeam& seam) {
  if (!seam.used) return MapSymbol::kSeamUnused;
  switch (seam.after.Verdict()) {
    case SeamVerdict::kGood:
      return MapSymbol::kSeamGood;
    case SeamVerdict::kDoubtful:
      return MapSymbol::kSeamDoubtful;
    case SeamVerdict::kBad:
      return MapSymbol::kSeamBad;
    case SeamVerdict::kUnknown:
      break;
  }
  return MapSymbol::kSeamUnknown;
}

std::string TitleOf(const ReportSeam& seam) {
  std::string title = absl::StrCat("seam ",
                                   seam.cluster_a,
                                   " - ",
                                   seam.cluster_b,
                                   "\n",
                                   seam.common_images,
                                   " common images, ",
                                   CountText(seam.inlier_tracks),
                                   " of ",
                                   CountText(seam.common_tracks),
                                   " common tracks agree");
  if (seam.after.images > 0) {
    absl::StrAppend(&title,
                    "\nafter the adjustment ",
                    ShortText(seam.after.Ratio()),
                    " times the noise: ",
                    VerdictText(seam.after.Verdict()));
  }
  if (!seam.used) absl::StrAppend(&title, "\nnot used: ", EscapeHtml(seam.reason));
  return title;
}

std::string Seams(const JobReport& report, const MapImages& images, const MapView& view) {
  std::map<int, MapImages> by_cluster;
  for (const ReportImage* image : images) by_cluster[image->cluster].push_back(image);
  std::string svg;
  const double r = report.seams.size() > 120 ? 3.0 : report.seams.size() > 40 ? 5.0 : 8.0;
  for (const ReportSeam& seam : report.seams) {
    const std::optional<Eigen::Vector3d> place = SeamPlace(by_cluster, seam);
    if (place) svg += DrawnSymbol(SymbolOf(seam), view.Page(*place), r, "", TitleOf(seam));
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

/// In the upper corner that the trajectory leaves freer.
std::string NorthArrow(const MapImages& images, const MapView& view) {
  constexpr double kFromEdge = 34.0;
  constexpr double kFromTop = 44.0;
  double best_distance = -1.0;
  double best_x = 0.0;
  for (const double x : {kMapWidth - kFromEdge, kFromEdge}) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const ReportImage* image : images) {
      nearest = std::min(
          nearest,
          (view.Page(image->centre_in_world) - Eigen::Vector2d(x, kFromTop)).squaredNorm());
    }
    if (nearest <= best_distance) continue;
    best_distance = nearest;
    best_x = x;
    constexpr double kFree = 80.0;
    if (nearest > kFree * kFree) break;  // the right one, where readers look first
  }
  return absl::StrCat("<g transform=\"translate(",
                      DecimalText(best_x, 1),
                      ",",
                      DecimalText(kFromTop, 1),
                      ")\"><path class=\"north\" d=\"M0,-24l7,22l-7,-5l-7,5z\"/>"
                      "<text text-anchor=\"middle\" y=\"16\">N</text></g>");
}

std::string ColorEntry(int color, const std::string& text) {
  return absl::StrCat("<span><i class=\"", ColorClass(color), "\"></i>", text, "</span>");
}

std::string ModelKey(const JobReport& report, const MapFrame& frame) {
  std::string key;
  for (size_t i = 0; i < std::min<size_t>(frame.models.size(), kMapLooks); ++i) {
    const uint32_t model = frame.models[i];
    key += ColorEntry(
        static_cast<int>(i),
        absl::StrCat("model ", model, " (", CountText(report.each_model[model].images), ")"));
  }
  if (frame.models.size() > kMapLooks) {
    absl::StrAppend(&key,
                    "<span>and ",
                    frame.models.size() - kMapLooks,
                    " smaller models, in the same colours again</span>");
  }
  return key;
}

/// The clusters of a map with few, else that colours are theirs.
std::string ClusterKey(const JobReport& report, const MapFrame& frame) {
  const std::vector<int> colors = ColorsOfClusters(report);
  std::map<int, bool> shown;
  for (const ReportImage* image : ImagesOf(report, frame)) {
    if (!image->loose) shown[image->cluster] = true;
  }
  if (shown.size() < 2) return "";
  if (shown.size() > kMapColors)
    return absl::StrCat("<span>colours: ",
                        shown.size(),
                        " clusters; those with a seam between them differ, others share ",
                        kMapColors,
                        " colours</span>");
  std::string key;
  for (const auto& [cluster, yes] : shown) {
    const bool known = cluster >= 0 && std::cmp_less(cluster, colors.size());
    key += ColorEntry(known ? colors[static_cast<size_t>(cluster)] : -1,
                      cluster < 0 ? "no cluster" : absl::StrCat("cluster ", cluster));
  }
  return key;
}

/// "17,000 of 20,000 panoramas are not drawn"; empty where all are.
std::string NotDrawn(size_t drawn, size_t all, const char* what) {
  if (drawn >= all) return "";
  return absl::StrCat(
      "<span>", CountText(all - drawn), " of ", CountText(all), " ", what, " are not drawn</span>");
}

std::string LeftOffTheMap(const JobReport& report, const MapFrame& frame) {
  const MapImages images = ImagesOf(report, frame);
  const size_t stride = std::max<size_t>(StrideOf(images.size()), 1);
  return NotDrawn((images.size() + stride - 1) / stride, images.size(), "panoramas with a pose") +
         NotDrawn(kMaxMarks, MissingImages(report, frame).size(), "panoramas without a pose") +
         NotDrawn(kMaxMarks, ContradictedImages(images).size(), "contradicted GNSS positions");
}

}  // namespace

std::vector<MapFrame> MapFrames(const JobReport& report) {
  std::vector<MapFrame> frames;
  std::vector<size_t> images;
  std::optional<size_t> on_earth;
  for (uint32_t model = 0; model < report.each_model.size(); ++model) {
    const bool georeferenced = report.each_model[model].gnss.used;
    if (!georeferenced || !on_earth) {
      if (georeferenced) on_earth = frames.size();
      frames.push_back({.georeferenced = georeferenced});
      images.push_back(0);
    }
    const size_t frame = georeferenced ? *on_earth : frames.size() - 1;
    frames[frame].models.push_back(model);
    images[frame] += report.each_model[model].images;
  }
  std::vector<size_t> order(frames.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, [&](size_t x, size_t y) { return images[x] > images[y]; });
  std::vector<MapFrame> sorted;
  for (const size_t i : order) sorted.push_back(std::move(frames[i]));
  return sorted;
}

std::string TrajectoryMapSvg(const JobReport& report, const MapFrame& frame) {
  const MapImages images = ImagesOf(report, frame);
  if (images.empty()) return "";
  const MapImages missing = FirstMarks(MissingImages(report, frame));
  const MapImages contradicted = FirstMarks(ContradictedImages(images));
  std::vector<Eigen::Vector3d> marks;
  for (const MapImages* list : {&missing, &contradicted}) {
    for (const ReportImage* image : *list) marks.push_back(*image->gnss_in_world);
  }
  const MapView view = FitMapView(images, frame.georeferenced, marks);
  return absl::StrCat("<svg class=\"map",
                      images.size() > kFewDots ? " many" : "",
                      "\" viewBox=\"0 0 ",
                      kMapWidth,
                      " ",
                      DecimalText(view.height, 0),
                      "\" role=\"img\" aria-label=\"Trajectory from above\">",
                      PathLines(report, frame, view),
                      UncertaintyEllipses(images, view),
                      Missing(missing, view),
                      GnssOutliers(contradicted, view),
                      Dots(report, images, MapColors(report, frame), view),
                      Seams(report, images, view),
                      images.size() > 1 ? ScaleBar(view, frame.georeferenced) : "",
                      frame.georeferenced && report.origin ? NorthArrow(images, view) : "",
                      "</svg>");
}

std::string MapKeyHtml(const JobReport& report, const MapFrame& frame, const std::string& map) {
  const std::string key =
      (frame.models.size() > 1 ? ModelKey(report, frame) : ClusterKey(report, frame)) +
      LegendOfSymbols(map) + LeftOffTheMap(report, frame);
  return key.empty() ? "" : "<div class=\"key\">" + key + "</div>";
}

}  // namespace orbweave
