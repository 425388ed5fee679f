// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/fit_growth.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orbweave {
namespace {

TEST(FitGrowth, FindsThePowerLawThroughItsOwnPoints) {
  std::vector<std::pair<double, double>> points;
  for (const double x : {50.0, 100.0, 300.0}) points.push_back({x, 0.2 * std::pow(x, 1.15)});
  const auto law = FitGrowth(points);
  ASSERT_TRUE(law.has_value());
  EXPECT_NEAR(law->exponent, 1.15, 1e-12);
  EXPECT_NEAR(law->factor, 0.2, 1e-12);
}

TEST(FitGrowth, DoesNotDependOnUnits) {
  const std::vector<std::pair<double, double>> seconds = {{1, 2}, {2, 5}, {4, 9}, {8, 21}};
  std::vector<std::pair<double, double>> hours;
  for (const auto& [x, y] : seconds) hours.push_back({1000.0 * x, y / 3600.0});
  EXPECT_NEAR(FitGrowth(seconds)->exponent, FitGrowth(hours)->exponent, 1e-12);
}

TEST(FitGrowth, LeavesOutWhatIsNotPositive) {
  const auto law = FitGrowth({{1, 3}, {10, 0}, {100, 300}, {1000, -1}});
  ASSERT_TRUE(law.has_value());
  EXPECT_NEAR(law->exponent, 1.0, 1e-12);
}

TEST(FitGrowth, SaysNothingAboutOneSize) {
  EXPECT_FALSE(FitGrowth({}).has_value());
  EXPECT_FALSE(FitGrowth({{7, 3}}).has_value());
  EXPECT_FALSE(FitGrowth({{7, 3}, {7, 4}, {7, 5}}).has_value());
}

}  // namespace
}  // namespace orbweave
