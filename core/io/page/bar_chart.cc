// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/page/bar_chart.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

constexpr double kHeight = 226.0;
constexpr double kLeft = 70.0;
constexpr double kRight = 10.0;
constexpr double kTop = 12.0;
constexpr double kBottom = 40.0;
constexpr double kBase = kHeight - kBottom;

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

std::string TickText(double x, double y, const std::string& text) {
  return absl::StrCat("<text class=\"tick\" text-anchor=\"middle\" x=\"",
                      DecimalText(x, 1),
                      "\" y=\"",
                      y,
                      "\">",
                      text,
                      "</text>");
}

std::string BarRect(const ChartBar& bar, double x, double y, double width) {
  return absl::StrCat("<rect class=\"bar",
                      bar.color.empty() ? "" : " " + bar.color,
                      "\" x=\"",
                      DecimalText(x, 2),
                      "\" y=\"",
                      DecimalText(y, 1),
                      "\" width=\"",
                      DecimalText(width, 2),
                      "\" height=\"",
                      DecimalText(kBase - y, 1),
                      bar.title.empty() ? "\"/>" : "\"><title>" + bar.title + "</title></rect>");
}

std::string MarkLine(const ChartMark& mark, double x) {
  return absl::StrCat("<path class=\"mark\" d=\"M",
                      DecimalText(x, 1),
                      ",",
                      kTop,
                      "V",
                      kBase,
                      "\"/><text class=\"marktext\" x=\"",
                      DecimalText(x + 5, 1),
                      "\" y=\"",
                      kTop + 10,
                      "\">",
                      mark.text,
                      "</text>");
}

}  // namespace

double NiceCeiling(double value) {
  if (value <= 0.0) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0}) {
    if (factor * power >= value * (1.0 - 1e-12)) return factor * power;
  }
  return 10.0 * power;
}

std::string BarChartSvg(const BarChart& chart) {
  double largest = 0.0;
  for (const ChartBar& bar : chart.bars) largest = std::max(largest, bar.value);
  const double top = NiceCeiling(largest);
  const auto num_bars = static_cast<double>(std::max<size_t>(chart.bars.size(), 1));
  const double bar_width = (chart.width - kLeft - kRight) / num_bars;
  const auto x_of = [&](double bar) { return kLeft + bar * bar_width; };
  const auto y_of = [&](double value) { return kBase - value / top * (kBase - kTop); };
  std::string svg = absl::StrCat("<svg class=\"",
                                 chart.classes,
                                 "\" viewBox=\"0 0 ",
                                 chart.width,
                                 " ",
                                 kHeight,
                                 "\" role=\"img\" aria-label=\"",
                                 EscapeHtml(chart.caption),
                                 "\">");
  for (const double share : {0.0, 0.5, 1.0})
    svg += Gridline(y_of(share * top), chart.width, AxisText(share * top));
  const double gap = bar_width > 4.0 ? 1.0 : 0.0;
  for (size_t i = 0; i < chart.bars.size(); ++i) {
    const ChartBar& bar = chart.bars[i];
    if (bar.value <= 0.0) continue;
    svg += BarRect(bar, x_of(static_cast<double>(i)) + 0.5 * gap, y_of(bar.value), bar_width - gap);
  }
  for (const ChartTick& tick : chart.ticks) svg += TickText(x_of(tick.bar), kBase + 17, tick.text);
  svg += TickText(0.5 * (kLeft + chart.width - kRight), kHeight - 4, EscapeHtml(chart.caption));
  if (chart.mark) svg += MarkLine(*chart.mark, x_of(std::min(chart.mark->bar, num_bars)));
  return svg + "</svg>";
}

}  // namespace orbweave
