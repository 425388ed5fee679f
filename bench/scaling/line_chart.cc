// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/line_chart.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

constexpr double kWidth = 520.0;
constexpr double kHeight = 300.0;
constexpr double kLeft = 60.0;
constexpr double kRight = 22.0;
constexpr double kTop = 22.0;
constexpr double kBottom = 36.0;

/// From values to places between two ends of the drawing.
struct Scale {
  bool log = true;
  double low = 1.0;
  double high = 10.0;
  double from = 0.0;
  double to = 1.0;

  [[nodiscard]] bool Has(double value) const {
    return std::isfinite(value) && (!log || value > 0.0);
  }
  [[nodiscard]] double operator()(double value) const {
    const double share =
        log ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
    return from + share * (to - from);
  }
  /// Where gridlines go: powers of ten, with 2 and 5 where these are few; or quarters.
  [[nodiscard]] std::vector<double> Ticks() const;
};

std::vector<double> Scale::Ticks() const {
  if (!log) {
    std::vector<double> quarters;
    for (int k = 0; k <= 4; ++k) quarters.push_back(low + 0.25 * k * (high - low));
    return quarters;
  }
  const bool few = high / low < 300.0;
  std::vector<double> ticks;
  for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, power) <= high;
       ++power) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = factor * std::pow(10.0, power);
      if ((few || factor == 1.0) && tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9))
        ticks.push_back(tick);
    }
  }
  return ticks;
}

/// The ends of a logarithmic axis over all points: a little more than they need.
Scale LogScale(const std::vector<ChartLine>& lines, bool of_x, double from, double to) {
  double low = HUGE_VAL;
  double high = 0.0;
  for (const ChartLine& line : lines) {
    for (const auto& [x, y] : line.points) {
      const double value = of_x ? x : y;
      if (!(value > 0.0) || !std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (high <= 0.0) return {.from = from, .to = to};
  const double room = of_x ? 1.0 : 1.15;
  if (high < 1.5 * low) return {true, low / 2.0, high * 2.0, from, to};
  return {true, low / room, high * room, from, to};
}

std::string GridSvg(const Scale& x, const Scale& y) {
  std::string svg;
  for (const double tick : y.Ticks()) {
    const std::string at = DecimalText(y(tick), 1);
    absl::StrAppend(&svg,
                    "<path class=\"grid\" d=\"M",
                    kLeft,
                    ",",
                    at,
                    "H",
                    kWidth - kRight,
                    "\"/><text text-anchor=\"end\" x=\"",
                    kLeft - 6,
                    "\" y=\"",
                    DecimalText(y(tick) + 4.0, 1),
                    "\">",
                    ShortText(tick),
                    "</text>");
  }
  for (const double tick : x.Ticks()) {
    const std::string at = DecimalText(x(tick), 1);
    absl::StrAppend(&svg,
                    "<path class=\"grid\" d=\"M",
                    at,
                    ",",
                    kTop,
                    "V",
                    kHeight - kBottom,
                    "\"/><text text-anchor=\"middle\" x=\"",
                    at,
                    "\" y=\"",
                    kHeight - kBottom + 15.0,
                    "\">",
                    ShortText(tick),
                    "</text>");
  }
  return svg;
}

std::string LineSvg(const ChartLine& line, const Scale& x, const Scale& y) {
  std::string path;
  std::string dots;
  for (const auto& [x_value, y_value] : line.points) {
    if (!x.Has(x_value) || !y.Has(y_value)) continue;
    const std::string px = DecimalText(x(x_value), 1);
    const std::string py = DecimalText(y(y_value), 1);
    absl::StrAppend(&path, path.empty() ? "M" : "L", px, ",", py);
    absl::StrAppend(&dots,
                    "<circle cx=\"",
                    px,
                    "\" cy=\"",
                    py,
                    "\" r=\"",
                    line.marks ? 4.5 : 2.0,
                    "\" style=\"fill:",
                    line.color,
                    "\"><title>",
                    EscapeHtml(line.name),
                    ": ",
                    ShortText(x_value),
                    ", ",
                    ShortText(y_value),
                    "</title></circle>");
  }
  if (line.marks || path.empty()) return dots;
  return absl::StrCat("<path style=\"fill:none;stroke:",
                      line.color,
                      ";stroke-width:2",
                      line.dashed ? ";stroke-dasharray:6 4" : "",
                      "\" d=\"",
                      path,
                      "\"/>",
                      dots);
}

}  // namespace

std::string LineChartSvg(const std::vector<ChartLine>& lines, const ChartAxes& axes) {
  const Scale x = LogScale(lines, true, kLeft, kWidth - kRight);
  const double base = kHeight - kBottom;
  const Scale y =
      axes.log_y ? LogScale(lines, false, base, kTop) : Scale{false, 0.0, axes.y_max, base, kTop};
  std::string svg = absl::StrCat("<svg class=\"chart\" viewBox=\"0 0 ",
                                 kWidth,
                                 " ",
                                 kHeight,
                                 "\" role=\"img\" aria-label=\"",
                                 EscapeHtml(axes.y),
                                 " over ",
                                 EscapeHtml(axes.x),
                                 "\">",
                                 GridSvg(x, y));
  for (const ChartLine& line : lines) svg += LineSvg(line, x, y);
  absl::StrAppend(&svg,
                  "<text x=\"4\" y=\"12\">",
                  EscapeHtml(axes.y),
                  "</text><text text-anchor=\"middle\" x=\"",
                  0.5 * (kLeft + kWidth - kRight),
                  "\" y=\"",
                  kHeight - 4.0,
                  "\">",
                  EscapeHtml(axes.x),
                  "</text></svg>");
  return svg;
}

std::string LineKeyHtml(const std::vector<ChartLine>& lines) {
  std::string key;
  for (const ChartLine& line : lines) {
    absl::StrAppend(&key,
                    "<span><i style=\"",
                    line.marks
                        ? "background:" + line.color
                        : absl::StrCat("border-radius:0;height:0;background:none;border-top:",
                                       line.dashed ? "2px dashed " : "2px solid ",
                                       line.color,
                                       ";vertical-align:4px"),
                    "\"></i>",
                    EscapeHtml(line.name),
                    "</span>");
  }
  return "<div class=\"key\">" + key + "</div>";
}

}  // namespace orbweave
