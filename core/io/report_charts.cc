// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/report_charts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/io/cluster_colors.h"
#include "core/io/html_text.h"

namespace orbweave {
namespace {

constexpr double kHalfWidth = 520.0;
constexpr double kFullWidth = 1080.0;
constexpr double kHeight = 226.0;
constexpr double kLeft = 70.0;
constexpr double kRight = 10.0;
constexpr double kTop = 12.0;
constexpr double kBottom = 40.0;

struct Bar {
  double value = 0.0;
  std::string title{};
  std::string color{};  ///< class of the stylesheet; empty: the accent colour
};

/// A label below the boundary before bar `bar` (or below its middle).
struct Tick {
  double bar = 0.0;
  std::string text{};
};

/// The smallest round number that is not below `value`.
double NiceCeiling(double value) {
  if (value <= 0.0) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0}) {
    if (factor * power >= value * (1.0 - 1e-12)) return factor * power;
  }
  return 10.0 * power;
}

/// Short enough for the space left of a chart.
std::string AxisText(double value) {
  return value < 1e6 ? ShortText(value) : ShortText(1e-6 * value) + " M";
}

std::string Gridline(double y, double width, const std::string& label) {
  const std::string y_text = DecimalText(y, 1);
  return absl::StrCat("<path class=\"grid\" d=\"M",
                      kLeft,
                      ",",
                      y_text,
                      "H",
                      width - kRight,
                      "\"/><text class=\"tick\" text-anchor=\"end\" x=\"",
                      kLeft - 6,
                      "\" y=\"",
                      DecimalText(y + 4, 1),
                      "\">",
                      label,
                      "</text>");
}

/// Vertical bars with a value axis, tick labels and a caption below. `extra` is drawn on top.
std::string BarChart(const std::string& classes,
                     double width,
                     const std::vector<Bar>& bars,
                     const std::vector<Tick>& ticks,
                     const std::string& caption,
                     const std::function<std::string(double bar_width)>& extra = {}) {
  double largest = 0.0;
  for (const Bar& bar : bars) largest = std::max(largest, bar.value);
  const double top = NiceCeiling(largest);
  const double bar_width =
      (width - kLeft - kRight) / static_cast<double>(std::max<size_t>(bars.size(), 1));
  const double base = kHeight - kBottom;
  const auto y_of = [&](double value) { return base - value / top * (base - kTop); };
  std::string svg = absl::StrCat("<svg class=\"",
                                 classes,
                                 "\" viewBox=\"0 0 ",
                                 width,
                                 " ",
                                 kHeight,
                                 "\" role=\"img\" aria-label=\"",
                                 EscapeHtml(caption),
                                 "\">");
  for (const double share : {0.0, 0.5, 1.0})
    svg += Gridline(y_of(share * top), width, AxisText(share * top));
  const double gap = bar_width > 4.0 ? 1.0 : 0.0;
  for (size_t i = 0; i < bars.size(); ++i) {
    if (bars[i].value <= 0.0) continue;
    const double y = y_of(bars[i].value);
    absl::StrAppend(&svg,
                    "<rect class=\"bar",
                    bars[i].color.empty() ? "" : " " + bars[i].color,
                    "\" x=\"",
                    DecimalText(kLeft + static_cast<double>(i) * bar_width + 0.5 * gap, 2),
                    "\" y=\"",
                    DecimalText(y, 1),
                    "\" width=\"",
                    DecimalText(bar_width - gap, 2),
                    "\" height=\"",
                    DecimalText(base - y, 1),
                    "\"",
                    bars[i].title.empty() ? "/>" : "><title>" + bars[i].title + "</title></rect>");
  }
  for (const Tick& tick : ticks) {
    absl::StrAppend(&svg,
                    "<text class=\"tick\" text-anchor=\"middle\" x=\"",
                    DecimalText(kLeft + tick.bar * bar_width, 1),
                    "\" y=\"",
                    base + 17,
                    "\">",
                    tick.text,
                    "</text>");
  }
  absl::StrAppend(&svg,
                  "<text class=\"tick\" text-anchor=\"middle\" x=\"",
                  0.5 * (kLeft + width - kRight),
                  "\" y=\"",
                  kHeight - 4,
                  "\">",
                  EscapeHtml(caption),
                  "</text>");
  if (extra) svg += extra(bar_width);
  return svg + "</svg>";
}

double ShareOf(double part, double whole) { return whole > 0.0 ? 100.0 * part / whole : 0.0; }

}  // namespace

std::string ResidualHistogramSvg(const JobReport& report) {
  const Histogram& histogram = report.residual_histogram;
  const double width = histogram.bin_width;
  std::vector<Bar> bars;
  std::vector<Tick> ticks;
  for (size_t i = 0; i < histogram.counts.size(); ++i) {
    const bool last = i + 1 == histogram.counts.size();
    const double low = static_cast<double>(i) * width;
    bars.push_back(
        {static_cast<double>(histogram.counts[i]),
         absl::StrCat(DecimalText(low, 1),
                      last ? " px and more: " : " to " + DecimalText(low + width, 1) + " px: ",
                      CountText(histogram.counts[i]),
                      " observations")});
    if (i % 10 == 0) ticks.push_back({static_cast<double>(i), DecimalText(low, 0)});
  }
  return BarChart(
      "chart", kHalfWidth, bars, ticks, "residual, pixels at the equator", [&](double bar_width) {
        const double x =
            kLeft +
            std::min(report.residual_px_mean / width, static_cast<double>(bars.size())) * bar_width;
        return absl::StrCat("<path class=\"mark\" d=\"M",
                            DecimalText(x, 1),
                            ",",
                            kTop,
                            "V",
                            kHeight - kBottom,
                            "\"/><text class=\"marktext\" x=\"",
                            DecimalText(x + 5, 1),
                            "\" y=\"",
                            kTop + 10,
                            "\">mean ",
                            DecimalText(report.residual_px_mean, 2),
                            " px</text>");
      });
}

std::string TrackLengthSvg(const JobReport& report) {
  std::vector<Bar> bars;
  std::vector<Tick> ticks;
  for (size_t n = 2; n < report.track_lengths.size(); ++n) {
    const bool last = n + 1 == report.track_lengths.size();
    const double count = static_cast<double>(report.track_lengths[n]);
    bars.push_back({count,
                    absl::StrCat(n,
                                 last ? " images and more: " : " images: ",
                                 CountText(report.track_lengths[n]),
                                 " points (",
                                 DecimalText(ShareOf(count, static_cast<double>(report.points)), 1),
                                 " %)")});
    if (n % 2 == 0)
      ticks.push_back({static_cast<double>(n) - 1.5, absl::StrCat(n, last ? "+" : "")});
  }
  return BarChart("chart", kHalfWidth, bars, ticks, "images that see a point");
}

namespace {

/// At most `max_bars`, groups of images sharing one. `titled`: bars tell their numbers.
std::string TracksPerImage(const JobReport& report,
                           const std::string& classes,
                           double width,
                           size_t max_bars,
                           bool titled) {
  const size_t group = std::max<size_t>((report.images.size() + max_bars - 1) / max_bars, 1);
  const std::vector<int> colors = ColorsOfClusters(report);
  std::vector<Bar> bars;
  for (size_t begin = 0; begin < report.images.size(); begin += group) {
    const size_t end = std::min(begin + group, report.images.size());
    double sum = 0.0;
    for (size_t i = begin; i < end; ++i) sum += report.images[i].observations;
    const double mean = sum / static_cast<double>(end - begin);
    const ReportImage& first = report.images[begin];
    const bool known = first.cluster >= 0 && std::cmp_less(first.cluster, colors.size());
    std::string title;
    if (titled) {
      title = absl::StrCat(EscapeHtml(first.name),
                           end - begin > 1 ? absl::StrCat(" and ", end - begin - 1, " more") : "",
                           ": ",
                           ShortText(mean),
                           " tracks");
    }
    bars.push_back({mean,
                    std::move(title),
                    ColorClass(known ? colors[static_cast<size_t>(first.cluster)] : -1)});
  }
  std::vector<Tick> ticks;
  const double step = NiceCeiling(static_cast<double>(report.images.size()) / 5.0);
  for (double i = 0.0; i < static_cast<double>(report.images.size()); i += std::max(step, 1.0)) {
    ticks.push_back({i / static_cast<double>(group), CountText(static_cast<uint64_t>(i))});
  }
  return BarChart(
      classes,
      width,
      bars,
      ticks,
      report.clusters.size() > 1 ? "image, in order; colour: cluster" : "image, in order");
}

}  // namespace

std::string TracksPerImageSvg(const JobReport& report) {
  return TracksPerImage(report, "chart only-wide", kFullWidth, 450, true) +
         TracksPerImage(report, "chart only-narrow", kHalfWidth, 120, false);
}

std::string StageTimesHtml(const JobReport& report) {
  double longest = 1e-9;
  for (const ReportStage& stage : report.stages)
    longest = std::max({longest, stage.wall_s, stage.cpu_s});
  std::string html =
      "<table class=\"stages\"><thead><tr><th>stage</th><th>wall s</th><th>CPU s</th><th "
      "class=\"wide minor\"></th><th "
      "class=\"minor\">computed</th><th>reused</th></tr></thead><tbody>";
  for (const ReportStage& stage : report.stages) {
    absl::StrAppend(
        &html,
        "<tr><td class=\"text\">",
        EscapeHtml(stage.name),
        "</td><td>",
        SecondsText(stage.wall_s),
        "</td><td>",
        SecondsText(stage.cpu_s),
        "</td><td class=\"wide minor\"><div class=\"wall\" style=\"width:",
        DecimalText(100.0 * stage.wall_s / longest, 2),
        "%\"></div><div class=\"cpu\" style=\"width:",
        DecimalText(100.0 * stage.cpu_s / longest, 2),
        "%\"></div></td><td class=\"minor\">",
        CountText(stage.tasks_computed),
        stage.retries > 0 ? absl::StrCat(" <small>", stage.retries, " again</small>") : "",
        "</td><td>",
        CountText(stage.tasks_reused),
        "</td></tr>");
  }
  return html + "</tbody></table>";
}

}  // namespace orbweave
