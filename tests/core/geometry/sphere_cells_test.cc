// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/sphere_cells.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace orbweave
