// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace orbweave {

struct ChartBar {
  double value = 0.0;
  std::string title{};  ///< HTML, shown when pointed at
  std::string color{};  ///< class of the stylesheet; empty: the accent colour
};

/// A label below the boundary before bar `bar` (or below its middle, at bar + 0.5).
struct ChartTick {
  double bar = 0.0;
  std::string text{};  ///< HTML
};

/// A dashed line from top to bottom, named.
struct ChartMark {
  double bar = 0.0;
  std::string text{};  ///< HTML
};

inline constexpr double kHalfChart = 520.0;
inline constexpr double kFullChart = 1080.0;

struct BarChart {
  std::string classes = "chart";
  double width = kHalfChart;
  std::vector<ChartBar> bars{};
  std::vector<ChartTick> ticks{};
  std::string caption{};  ///< text below the chart
  std::optional<ChartMark> mark{};
};

/// Vertical bars over a value axis from 0, as an SVG element.
[[nodiscard]] std::string BarChartSvg(const BarChart& chart);

/// The smallest round number that is not below `value`; 1 where that is not positive.
[[nodiscard]] double NiceCeiling(double value);

}  // namespace orbweave
