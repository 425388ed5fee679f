// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/tile_grid.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

TEST(QuantisedPosition, MovesByLessThanHalfAQuantumAndOnlyOnce) {
  Random random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vector3d position = testing::RandomPoint(random, 0.0, 1e5);
    const Vector3d quantised = QuantisedPosition(position);
    EXPECT_LE((quantised - position).cwiseAbs().maxCoeff(), 0.50001 * kPositionQuantum_m);
    EXPECT_EQ(QuantisedPosition(quantised), quantised);
  }
}

TEST(TileGrid, GivesBordersToTheUpperCell) {
  const TileGrid grid;
  EXPECT_EQ(grid.CellOf({0.0, 0.0, 5.0}), (TileCell{0, 0}));
  EXPECT_EQ(grid.CellOf({8.0, -8.0, -5.0}), (TileCell{1, -1}));
  EXPECT_EQ(grid.CellOf({7.9995, -8.0005, 0.0}), (TileCell{0, -2}));
  EXPECT_EQ(grid.CellOf({-0.0005, -0.0, 0.0}), (TileCell{-1, 0}));
}

TEST(TileGrid, NestsSmallCellsInLargeOnes) {
  Random random(2);
  const TileGrid small = {4.0};
  const TileGrid large = {8.0};
  for (int trial = 0; trial < 1000; ++trial) {
    const Vector3d X = QuantisedPosition(testing::RandomPoint(random, 0.0, 100.0));
    const TileCell cell = small.CellOf(X);
    EXPECT_EQ(large.CellOf(X).x, (cell.x - (cell.x & 1)) / 2);
    EXPECT_EQ(large.CellOf(X).y, (cell.y - (cell.y & 1)) / 2);
  }
}

TEST(GroupByTile, OrdersPointsTheSameHoweverTheyCame) {
  Random random(3);
  std::vector<SurfacePoint> points(500);
  for (SurfacePoint& point : points) {
    point.position_in_world = QuantisedPosition(testing::RandomPoint(random, 0.0, 20.0));
    point.sigma_m = static_cast<float>(random.Uniform());
  }
  points.push_back(points[7]);
  points.back().color = {1, 2, 3};
  auto reversed = points;
  std::ranges::reverse(reversed);
  const auto runs = GroupByTile({}, points);
  EXPECT_GT(runs.size(), 10U);
  EXPECT_TRUE(std::ranges::is_sorted(runs, {}, &TileRun::cell));
  EXPECT_EQ(GroupByTile({}, reversed).size(), runs.size());
  EXPECT_EQ(reversed, points);
  std::vector<SurfacePoint> none;
  EXPECT_TRUE(GroupByTile({}, none).empty());
}

}  // namespace
}  // namespace orbweave
