// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/report_charts.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/io/page/bar_chart.h"
#include "core/io/page/cluster_colors.h"
#include "core/io/page/html_page.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

double ShareOf(double part, double whole) { return whole > 0.0 ? 100.0 * part / whole : 0.0; }

}  // namespace

std::string ResidualHistogramSvg(const JobReport& report) {
  const Histogram& histogram = report.residual_histogram;
  const double width = histogram.bin_width;
  std::vector<ChartBar> bars;
  std::vector<ChartTick> ticks;
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
  return BarChartSvg(
      {.bars = std::move(bars),
       .ticks = std::move(ticks),
       .caption = "residual, pixels at the equator",
       .mark = ChartMark{report.residual_px_mean / width,
                         "mean " + DecimalText(report.residual_px_mean, 2) + " px"}});
}

std::string TrackLengthSvg(const JobReport& report) {
  std::vector<ChartBar> bars;
  std::vector<ChartTick> ticks;
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
  return BarChartSvg(
      {.bars = std::move(bars), .ticks = std::move(ticks), .caption = "images that see a point"});
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
  std::vector<ChartBar> bars;
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
  std::vector<ChartTick> ticks;
  const double step = NiceCeiling(static_cast<double>(report.images.size()) / 5.0);
  for (double i = 0.0; i < static_cast<double>(report.images.size()); i += std::max(step, 1.0)) {
    ticks.push_back({i / static_cast<double>(group), CountText(static_cast<uint64_t>(i))});
  }
  return BarChartSvg({.classes = classes,
                      .width = width,
                      .bars = std::move(bars),
                      .ticks = std::move(ticks),
                      .caption = report.clusters.size() > 1 ? "image, in order; colour: cluster"
                                                            : "image, in order"});
}

}  // namespace

std::string TracksPerImageSvg(const JobReport& report) {
  return TracksPerImage(report, "chart only-wide", kFullChart, 450, true) +
         TracksPerImage(report, "chart only-narrow", kHalfChart, 120, false);
}

namespace {

std::string StagesTable(std::span<const ReportStage> stages) {
  double longest = 1e-9;
  for (const ReportStage& stage : stages) longest = std::max({longest, stage.wall_s, stage.cpu_s});
  std::string html =
      "<table class=\"stages\"><thead><tr><th>stage</th><th>wall s</th><th>CPU s</th><th "
      "class=\"wide minor\"></th><th "
      "class=\"minor\">computed</th><th>reused</th></tr></thead><tbody>";
  for (const ReportStage& stage : stages) {
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

}  // namespace

std::string TimesHtml(double elapsed_s, std::span<const ReportStage> stages) {
  if (stages.empty()) return "";
  double cpu_s = 0.0;
  uint64_t reused = 0;
  for (const ReportStage& stage : stages) {
    cpu_s += stage.cpu_s;
    reused += stage.tasks_reused;
  }
  const std::string subtitle =
      absl::StrCat(DurationText(elapsed_s),
                   " in all, ",
                   DurationText(cpu_s),
                   " of CPU; ",
                   CountText(reused),
                   reused == 1 ? " task was found finished." : " tasks were found finished.");
  return Section(
      "Time",
      subtitle,
      StagesTable(stages) +
          "<div class=\"key only-wide\"><span><i class=\"wall\"></i>wall clock</span><span><i "
          "class=\"cpu\"></i>CPU</span></div>");
}

}  // namespace orbweave
