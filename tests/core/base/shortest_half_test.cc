// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/shortest_half.h"

#include <gtest/gtest.h>

#include <vector>

namespace orbweave {
namespace {

TEST(ShortestHalf, LiesWhereMoreThanHalfLieClosest) {
  const Interval half = ShortestHalf({9.0, 1.0, 1.1, -7.0, 1.2, 4.0, 1.05});
  EXPECT_EQ(half.low, 1.0);
  EXPECT_EQ(half.high, 1.2);
}

TEST(ShortestHalf, IsNotMovedByWhatLiesElsewhere) {
  std::vector<double> values = {2.0, 2.1, 2.2, 2.3, 2.4};
  const Interval alone = ShortestHalf({2.0, 2.1, 2.2, 2.3, 2.4});
  for (const double far : {50.0, 60.0, -80.0}) values.push_back(far);
  const Interval among = ShortestHalf(values);
  EXPECT_GE(among.low, 2.0);
  EXPECT_LE(among.high, 2.4);
  EXPECT_LE(alone.high - alone.low, among.high - among.low);
}

TEST(ShortestHalf, MovesAndStretchesWithTheValues) {
  const std::vector<double> values = {0.3, 0.1, 0.9, 0.35, 2.0, 0.31};
  std::vector<double> moved;
  for (const double value : values) moved.push_back(4.0 * value - 8.0);
  const Interval half = ShortestHalf(values);
  const Interval of_moved = ShortestHalf(moved);
  EXPECT_DOUBLE_EQ(of_moved.low, 4.0 * half.low - 8.0);
  EXPECT_DOUBLE_EQ(of_moved.high, 4.0 * half.high - 8.0);
}

TEST(ShortestHalf, OfEqualOnesTakesTheLowest) {
  const Interval half = ShortestHalf({4.0, 2.0, 3.0, 1.0});
  EXPECT_EQ(half.low, 1.0);
  EXPECT_EQ(half.high, 3.0);
}

TEST(ShortestHalf, OfOneValueIsThatValue) {
  const Interval half = ShortestHalf({5.0});
  EXPECT_EQ(half.low, 5.0);
  EXPECT_EQ(half.high, 5.0);
}

}  // namespace
}  // namespace orbweave
