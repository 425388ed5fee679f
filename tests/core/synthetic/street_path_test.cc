// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/street_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/synthetic/street_layout.h"

namespace orbweave {
namespace {

TEST(StreetPath, IsWalkedByArcLength) {
  const StreetPath path({{0, 0}, {50, 0}, {50, 30}, {90, 60}}, 8.0, false);
  for (double s = 0.0; s + 0.1 < path.length_m(); s += 0.1) {
    const double step_m = (path.At(s + 0.1).position - path.At(s).position).norm();
    ASSERT_NEAR(step_m, 0.1, 2e-4) << s;
    ASSERT_NEAR(path.At(s).direction.norm(), 1.0, 1e-12);
  }
}

TEST(StreetPath, ClosesAndWraps) {
  const StreetPath path({{0, 0}, {40, 0}, {40, 20}, {0, 20}}, 5.0, true);
  const double rounded_m = 120.0 - (8.0 - 2.0 * std::numbers::pi) * 5.0;
  EXPECT_NEAR(path.length_m(), rounded_m, 0.02);
  for (const double s : {-7.0, 3.0, 60.0}) {
    EXPECT_LT((path.At(s).position - path.At(s + path.length_m()).position).norm(), 1e-9);
  }
}

TEST(StreetPath, GoesStraightBeyondOpenEnds) {
  const StreetPath path({{0, 0}, {10, 0}}, 5.0, false);
  EXPECT_NEAR(path.At(12.0).position.x(), 12.0, 1e-12);
  EXPECT_NEAR(path.At(-2.0).position.x(), -2.0, 1e-12);
}

TEST(StreetPath, RoundsCornersThatTurnBackOnShortSides) {
  const StreetPath path({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 50.0, true);
  EXPECT_GT(path.length_m(), 3.0);
  EXPECT_LT(path.length_m(), 6.0);
}

TEST(StreetLayout, DistanceFromAxisIsZeroOnItAndPositiveToItsLeft) {
  const StreetLayout layout = MakeStreetLayout(150.0);
  EXPECT_NEAR(layout.axis.length_m(), 150.0, 0.1);
  for (double s = 0.0; s < layout.axis.length_m(); s += 1.7) {
    const PathPlace place = layout.axis.At(s);
    EXPECT_NEAR(layout.DistanceFromAxis(place.position), 0.0, 0.01);
    EXPECT_NEAR(layout.DistanceFromAxis(place.position + 3.0 * place.Left()), 3.0, 0.02);
    EXPECT_NEAR(layout.DistanceFromAxis(place.position - 3.0 * place.Left()), -3.0, 0.02);
  }
}

}  // namespace
}  // namespace orbweave
