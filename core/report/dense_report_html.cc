// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/dense_report_html.h"

#include <algorithm>
#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/io/page/bar_chart.h"
#include "core/io/page/html_page.h"
#include "core/io/page/html_text.h"
#include "core/io/page/report_charts.h"
#include "core/io/page/report_tables.h"

namespace orbweave {
namespace {

constexpr size_t kMaxCoverageBars = 450;

const char* UnitOf(const DenseReport& report) { return report.is_metric ? "m" : "units"; }
const char* SmallUnitOf(const DenseReport& report) {
  return report.is_metric ? "mm" : "thousandths of the step between panoramas";
}

std::string PercentText(double share) { return DecimalText(100.0 * share, 0); }

double ShareOf(uint64_t part, uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

std::string Cards(const DenseReport& report) {
  const auto with_depth = static_cast<uint64_t>(std::ranges::count_if(
      report.maps, [](const DepthMapReport& map) { return map.coverage > 0.0; }));
  return absl::StrCat(
      "<div class=\"cards\">",
      CountCard(report.num_points, "points"),
      Card(CountText(with_depth), "of " + CountText(report.maps.size()), "panoramas have depth"),
      Card(PercentText(report.Coverage()),
           "%",
           "of their spheres, in the mean, have a depth that "
           "another panorama bears out"),
      Card(CountText(report.tiles.size()), "", report.tiles.size() == 1 ? "tile" : "tiles"),
      report.maps.empty()
          ? ""
          : Card(SecondsText(report.Cpu_s() / static_cast<double>(report.maps.size())),
                 "s",
                 "of CPU a panorama"),
      "</div>\n");
}

std::string Embedded(const std::string& kind, const std::string& bytes) {
  return absl::StrCat("data:image/", kind, ";base64,", absl::Base64Escape(bytes));
}

std::string FromAbove(const DenseReport& report, const DensePictures& pictures) {
  if (pictures.from_above_png.empty())
    return Section("The cloud from above", "There is no point.", "");
  return Section("The cloud from above",
                 absl::StrCat("The highest point of each pixel; a pixel is ",
                              ShortText(pictures.pixel),
                              " ",
                              UnitOf(report),
                              " wide. Also in from_above.png."),
                 absl::StrCat("<img class=\"shot\" alt=\"The cloud from above\" src=\"",
                              Embedded("png", pictures.from_above_png),
                              "\">"));
}

std::string DepthMaps(const DensePictures& pictures) {
  if (pictures.depths.empty()) return "";
  std::string figures;
  for (const DensePictures::Depth& depth : pictures.depths) {
    absl::StrAppend(&figures,
                    "<figure><img alt=\"\" src=\"",
                    Embedded("jpeg", depth.jpeg),
                    "\"><figcaption>",
                    EscapeHtml(depth.image),
                    "</figcaption></figure>");
  }
  return Section("Depth maps",
                 "Of panoramas evenly along the job: below each its checked distances. Dark: none.",
                 "<div class=\"pair\">" + figures + "</div>");
}

ChartBar BarOf(uint64_t count, const std::string& what, const DenseReport& report) {
  return {static_cast<double>(count),
          absl::StrCat(what,
                       ": ",
                       CountText(count),
                       " points (",
                       DecimalText(100.0 * ShareOf(count, report.num_points), 1),
                       " %)")};
}

std::string SigmaChart(const DenseReport& report) {
  std::vector<ChartBar> bars;
  std::vector<ChartTick> ticks;
  const auto& bounds = DenseReport::kSigmaBounds;
  for (size_t i = 0; i < report.by_sigma.size(); ++i) {
    const std::string what = i < bounds.size() ? absl::StrCat("below ", bounds[i], " ")
                                               : absl::StrCat(bounds.back(), " and more ");
    bars.push_back(BarOf(report.by_sigma[i], what + SmallUnitOf(report), report));
    if (i < bounds.size()) ticks.push_back({static_cast<double>(i) + 1.0, absl::StrCat(bounds[i])});
  }
  return BarChartSvg({.bars = std::move(bars),
                      .ticks = std::move(ticks),
                      .caption = absl::StrCat("sigma along the ray, ", SmallUnitOf(report))});
}

std::string ViewsChart(const DenseReport& report) {
  std::vector<ChartBar> bars;
  std::vector<ChartTick> ticks;
  for (size_t n = 1; n < report.by_views.size(); ++n) {
    const bool is_last = n + 1 == report.by_views.size();
    const std::string what = absl::StrCat(n, is_last ? " and more" : "");
    bars.push_back(BarOf(report.by_views[n], what + " panoramas", report));
    ticks.push_back({static_cast<double>(n) - 0.5, absl::StrCat(n, is_last ? "+" : "")});
  }
  return BarChartSvg({.bars = std::move(bars),
                      .ticks = std::move(ticks),
                      .caption = "panoramas that bear a point out"});
}

std::string Charts(const DenseReport& report) {
  if (report.num_points == 0) return "";
  return "<div class=\"pair\">" +
         Section("Sigmas", "Of the points, one standard deviation.", SigmaChart(report)) +
         Section("Views", "Points by the panoramas that agree on them.", ViewsChart(report)) +
         "</div>\n";
}

/// Groups of panoramas share a bar when there are many.
std::string Coverage(const DenseReport& report) {
  if (report.maps.empty()) return "";
  const size_t count = report.maps.size();
  const size_t group = (count + kMaxCoverageBars - 1) / kMaxCoverageBars;
  std::vector<ChartBar> bars;
  for (size_t begin = 0; begin < count; begin += group) {
    const size_t end = std::min(begin + group, count);
    double sum = 0.0;
    for (size_t i = begin; i < end; ++i) sum += report.maps[i].coverage;
    const double percent = 100.0 * sum / static_cast<double>(end - begin);
    bars.push_back({percent,
                    absl::StrCat(EscapeHtml(report.maps[begin].image),
                                 end - begin > 1 ? " and those after it" : "",
                                 ": ",
                                 DecimalText(percent, 1),
                                 " %")});
  }
  std::vector<ChartTick> ticks;
  const double step = std::max(1.0, NiceCeiling(static_cast<double>(count) / 10.0));
  for (double i = 0.0; i < static_cast<double>(count); i += step)
    ticks.push_back({i / static_cast<double>(group), CountText(static_cast<uint64_t>(i))});
  return Section("Coverage of each panorama",
                 "Share of the sphere that has a checked depth, in percent: sky, carrier and what "
                 "a single panorama sees have none.",
                 BarChartSvg({.width = kFullChart,
                              .bars = std::move(bars),
                              .ticks = std::move(ticks),
                              .caption = "panorama, in order"}));
}

std::string WithoutDepth(const DenseReport& report) {
  if (report.omitted.empty()) return "";
  return Section("Without depth",
                 CountText(report.omitted.size()) +
                     (report.omitted.size() == 1 ? " panorama." : " panoramas."),
                 ReasonsTable(report.omitted));
}

}  // namespace

std::string DenseReportHtml(const DenseReport& report, const DensePictures& pictures) {
  return HtmlPage(
      report.title.empty() ? "Dense cloud - Orbweave" : report.title + " - dense cloud - Orbweave",
      absl::StrCat(PageHead(report.title.empty() ? "Dense cloud" : report.title,
                            report.version,
                            "dense cloud · " + DurationText(report.elapsed_s)),
                   Cards(report),
                   FromAbove(report, pictures),
                   WithoutDepth(report),
                   DepthMaps(pictures),
                   Charts(report),
                   Coverage(report),
                   TimesHtml(report.elapsed_s, report.stages),
                   "<footer>All numbers of this page are in report.json.</footer>"));
}

}  // namespace orbweave
