// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/eight_point.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/geometry/essential.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::MakeTwoViewWorld;

double Distance(const Matrix3d& a, const Matrix3d& b) {
  return std::min((a - b).norm(), (a + b).norm());
}

TEST(SolveEightPoint, IsExactFromEightPairsAndFromMany) {
  for (const size_t count : {8, 9, 100}) {
    const auto world = MakeTwoViewWorld(count, count);
    const auto E = SolveEightPoint(world.bearings_a, world.bearings_b);
    ASSERT_TRUE(E.has_value());
    EXPECT_LT(Distance(*E, EssentialFromPose(world.b_from_a)), 1e-9) << count;
  }
}

TEST(SolveEightPoint, AveragesNoiseOut) {
  const auto world = MakeTwoViewWorld(1, 1000, 0.0, 1e-3);
  const auto E = SolveEightPoint(world.bearings_a, world.bearings_b);
  ASSERT_TRUE(E.has_value());
  EXPECT_LT(Distance(*E, EssentialFromPose(world.b_from_a)), 3e-3);
}

TEST(SolveEightPoint, RefusesFewPairsEqualBearingsAndPureRotation) {
  const auto world = MakeTwoViewWorld(1, 20);
  EXPECT_FALSE(
      SolveEightPoint(std::span(world.bearings_a).first(7), std::span(world.bearings_b).first(7))
          .has_value());
  const std::vector<Vector3d> equal(20, Vector3d::UnitX());
  EXPECT_FALSE(SolveEightPoint(equal, equal).has_value());
  EXPECT_FALSE(SolveEightPoint(world.bearings_a, world.bearings_a).has_value());
}

}  // namespace
}  // namespace orbweave
