// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/line_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(LineChartSvg, APowerLawIsStraight) {
  const std::string svg = LineChartSvg(
      {{.name = "T", .color = "red", .points = {{1, 100}, {10, 10}, {100, 1}}}}, {"P", "s"});
  // From (1, 100) to (100, 1): the middle decade lies in the middle.
  EXPECT_THAT(svg, HasSubstr("d=\"M60.0,"));
  EXPECT_THAT(svg, HasSubstr("L279.0,143.0L498.0,"));
}

TEST(LineChartSvg, LeavesOutWhatALogarithmDoesNotHave) {
  const std::string svg = LineChartSvg(
      {{.name = "T", .color = "red", .points = {{1, 5}, {2, 0}, {3, NAN}, {0, 4}, {10, 50}}}},
      {"P", "s"});
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_THAT(svg, HasSubstr("T: 10, 50"));
  EXPECT_THAT(svg, Not(HasSubstr("T: 2, 0")));
}

TEST(LineChartSvg, ALinearAxisReachesItsTop) {
  const std::string svg =
      LineChartSvg({{.name = "E", .color = "red", .points = {{1, 1}, {100, 0}}}},
                   {.x = "P", .y = "efficiency", .log_y = false});
  EXPECT_THAT(svg, HasSubstr("M60.0,22.0L498.0,264.0"));
}

TEST(LineChartSvg, DrawsAxesWithoutLinesAndAroundOnePoint) {
  EXPECT_THAT(LineChartSvg({}, {"P", "s"}), Not(HasSubstr("nan")));
  const std::string svg =
      LineChartSvg({{.name = "T", .color = "red", .points = {{4, 2}}}}, {"P", "s"});
  EXPECT_THAT(svg, HasSubstr("T: 4, 2"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(LineChartSvg, EscapesNames) {
  const std::vector<ChartLine> lines = {{.name = "<b>", .color = "red", .points = {{1, 2}}}};
  EXPECT_THAT(LineChartSvg(lines, {"P", "s"}), Not(HasSubstr("<b>")));
  EXPECT_THAT(LineKeyHtml(lines), Not(HasSubstr("<b>")));
}

}  // namespace
}  // namespace orbweave
