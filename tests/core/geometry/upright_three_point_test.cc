// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/upright_three_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::BearingOf;
using testing::RandomDirection;
using testing::RandomPoint;
using testing::RotationError;

struct UprightWorld {
  Rigid3 b_from_a{};
  std::array<Vector3d, 3> a{};
  std::array<Vector3d, 3> b{};
};

UprightWorld MakeUprightWorld(Random& random, double heading_rad) {
  UprightWorld world;
  world.b_from_a = {Eigen::Quaterniond(Eigen::AngleAxisd(heading_rad, Vector3d::UnitY())),
                    RandomDirection(random)};
  for (size_t i = 0; i < 3; ++i) {
    const Vector3d X = RandomPoint(random, 2.0, 10.0);
    world.a[i] = X.normalized();
    world.b[i] = BearingOf(world.b_from_a, X);
  }
  return world;
}

/// Up to the sign of T, which the solver leaves open.
double DistanceToNearest(const UprightWorld& world) {
  double least = std::numeric_limits<double>::infinity();
  for (const Rigid3& pose : SolveUprightThreePoint(world.a, world.b)) {
    const Vector3d& T = world.b_from_a.translation;
    least = std::min(least,
                     RotationError(pose.rotation, world.b_from_a.rotation) +
                         std::min((pose.translation - T).norm(), (pose.translation + T).norm()));
  }
  return least;
}

TEST(SolveUprightThreePoint, FindsThePoseForRandomHeadings) {
  Random random(1);
  int num_exact = 0;
  constexpr int kTrials = 1000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double heading = random.Uniform(-std::numbers::pi, std::numbers::pi);
    num_exact += DistanceToNearest(MakeUprightWorld(random, heading)) < 1e-6 ? 1 : 0;
  }
  EXPECT_GE(num_exact, kTrials * 99 / 100);
}

TEST(SolveUprightThreePoint, FindsPanoramasThatLookTheSameAndTheOppositeWay) {
  Random random(2);
  for (const double heading :
       {0.0, std::numbers::pi, -std::numbers::pi / 2, std::numbers::pi / 2}) {
    EXPECT_LT(DistanceToNearest(MakeUprightWorld(random, heading)), 1e-6) << heading;
  }
}

TEST(SolveUprightThreePoint, TurnsAboutTheVerticalOnlyAndFitsTheBearings) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const UprightWorld world = MakeUprightWorld(random, random.Uniform(-3.0, 3.0));
    const auto poses = SolveUprightThreePoint(world.a, world.b);
    EXPECT_LE(poses.size(), 4U);
    for (const Rigid3& pose : poses) {
      EXPECT_LT((pose.rotation * Vector3d::UnitY() - Vector3d::UnitY()).norm(), 1e-9);
      for (size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(world.b[i].dot(pose.translation.cross(pose.rotation * world.a[i])), 0.0, 1e-6)
            << trial;
      }
    }
  }
}

TEST(SolveUprightThreePoint, HasNoAnswerForEqualBearings) {
  const std::array<Vector3d, 3> equal = {Vector3d::UnitX(), Vector3d::UnitX(), Vector3d::UnitX()};
  EXPECT_TRUE(SolveUprightThreePoint(equal, equal).empty());
}

}  // namespace
}  // namespace orbweave
