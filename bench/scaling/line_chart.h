// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace orbweave {

struct ChartLine {
  std::string name{};
  std::string color{};                              ///< of CSS
  std::vector<std::pair<double, double>> points{};  ///< positive, by x
  bool dashed = false;
  bool marks = false;  ///< points only, no line between them
};

struct ChartAxes {
  std::string x{};  ///< what is drawn to the right, upwards
  std::string y{};
  bool log_y = true;  ///< else from 0 to y_max
  double y_max = 1.0;
};

/// Lines over a logarithmic x axis as an SVG element; points tell their numbers when pointed at.
/// Points that a logarithm does not have are left out; without any the chart is empty.
[[nodiscard]] std::string LineChartSvg(const std::vector<ChartLine>& lines, const ChartAxes& axes);

/// What the lines of a chart are, as HTML.
[[nodiscard]] std::string LineKeyHtml(const std::vector<ChartLine>& lines);

}  // namespace orbweave
