// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/sphere_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::RandomDirection;

TEST(SphereCell, HasCellsOfEqualArea) {
  Random random(1);
  std::vector<int> counts(64, 0);
  for (int trial = 0; trial < 64000; ++trial) ++counts[SphereCell(RandomDirection(random), 8)];
  for (const int count : counts) EXPECT_NEAR(count, 1000, 160);  // five standard deviations
}

TEST(SphereCell, StaysInRangeAtPolesAndSeam) {
  for (const Vector3d& bearing : {Vector3d(0, 1, 0),
                                  Vector3d(0, -1, 0),
                                  Vector3d(0, 1.0 + 1e-15, 0),
                                  Vector3d(0, 0, -1),
                                  Vector3d(-1e-300, 0, -1),
                                  Vector3d(-0.0, 0, -1)}) {
    EXPECT_LT(SphereCell(bearing, 32), 1024U) << bearing.transpose();
  }
}

TEST(SphereCell, FinerCellsNestInCoarserOnes) {
  Random random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vector3d bearing = RandomDirection(random);
    const uint32_t fine = SphereCell(bearing, 8);
    EXPECT_EQ(SphereCell(bearing, 4), (fine / 8 / 2) * 4 + (fine % 8) / 2);
  }
}

TEST(SphereSpread, GoesFromNothingToTheWholeSphere) {
  Random random(3);
  std::vector<Vector3d> bearings;
  EXPECT_EQ(SphereSpread(bearings), 0.0);
  bearings.push_back(Vector3d::UnitX());
  EXPECT_EQ(SphereSpread(bearings), 1.0 / 64.0);
  for (int i = 0; i < 2000; ++i) bearings.push_back(RandomDirection(random));
  EXPECT_EQ(SphereSpread(bearings), 1.0);
}

Eigen::Vector3d Towards(double azimuth_deg) {
  const double azimuth = azimuth_deg * std::numbers::pi / 180.0;
  return {std::sin(azimuth), 0.0, std::cos(azimuth)};
}

TEST(CountPlacesAround, IsNoneInOneHalfOfWhatStandsOnOneSide) {
  std::vector<Eigen::Vector3d> bearings;
  for (int i = 0; i < 80; ++i) bearings.push_back(Towards(-75.0 + 2.0 * i));
  const PlacesAround beside = CountPlacesAround(bearings);
  EXPECT_GE(beside.all, 14U);
  EXPECT_EQ(beside.of_emptier_half, 0U);
}

TEST(CountPlacesAround, IsHalfOfWhatIsAllAroundWhereverTheCameraLooks) {
  for (const double turn : {0.0, 90.0, 200.0}) {
    std::vector<Eigen::Vector3d> bearings;
    for (int i = 0; i < 720; ++i) bearings.push_back(Towards(turn + 0.5 * i));
    const PlacesAround around = CountPlacesAround(bearings);
    EXPECT_EQ(around.all, 32U);
    EXPECT_EQ(around.of_emptier_half, 16U);
  }
}

TEST(CountPlacesAround, CountsAPlaceOnce) {
  const std::vector<Eigen::Vector3d> bearings(50, Towards(10.0));
  EXPECT_EQ(CountPlacesAround(bearings).all, 1U);
  EXPECT_EQ(CountPlacesAround({}).all, 0U);
}

}  // namespace
}  // namespace orbweave
