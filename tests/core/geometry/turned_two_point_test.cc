// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/turned_two_point.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::BearingOf;
using testing::RandomDirection;
using testing::RandomPoint;
using testing::RandomRotation;

TEST(SolveTurnedTwoPoint, FindsTheDirectionWithItsSign) {
  Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const Rigid3 b_from_a{RandomRotation(random), RandomDirection(random)};
    const std::array points = {RandomPoint(random, 2.0, 10.0), RandomPoint(random, 2.0, 10.0)};
    const std::array a = {points[0].normalized(), points[1].normalized()};
    const std::array b = {BearingOf(b_from_a, points[0]), BearingOf(b_from_a, points[1])};
    const auto pose = SolveTurnedTwoPoint(b_from_a.rotation, a, b);
    ASSERT_TRUE(pose.has_value()) << trial;
    EXPECT_LT((pose->translation - b_from_a.translation).norm(), 1e-6) << trial;
    EXPECT_NEAR(pose->translation.norm(), 1.0, 1e-12) << trial;
    EXPECT_EQ(pose->rotation.coeffs(), b_from_a.rotation.coeffs()) << trial;
  }
}

TEST(SolveTurnedTwoPoint, HasNoneWhereNothingMovedOrBothAreTheSame) {
  Random random(2);
  const Eigen::Quaterniond R = RandomRotation(random);
  const Vector3d x = RandomDirection(random);
  const Vector3d y = RandomDirection(random);
  const std::array still_a = {Vector3d::UnitX().eval(), Vector3d::UnitY().eval()};
  EXPECT_FALSE(SolveTurnedTwoPoint(Eigen::Quaterniond::Identity(), still_a, still_a).has_value());
  EXPECT_FALSE(SolveTurnedTwoPoint(R, std::array{x, x}, std::array{y, y}).has_value());
}

}  // namespace
}  // namespace orbweave
