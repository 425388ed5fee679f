// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/p3p.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::BearingOf;
using testing::RandomPoint;
using testing::RandomRotation;
using testing::RotationError;

using Triple = std::array<Vector3d, 3>;

Triple BearingsOf(const Rigid3& pose, const Triple& points) {
  return {BearingOf(pose, points[0]), BearingOf(pose, points[1]), BearingOf(pose, points[2])};
}

double DistanceToNearest(const Rigid3& truth, const absl::InlinedVector<Rigid3, 4>& poses) {
  double least = std::numeric_limits<double>::infinity();
  for (const Rigid3& pose : poses) {
    least = std::min(
        least,
        RotationError(pose.rotation, truth.rotation) + (pose.Centre() - truth.Centre()).norm());
  }
  return least;
}

TEST(SolveP3p, FindsThePoseFromBearingsOfTheWholeSphere) {
  Random random(1);
  int num_exact = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Rigid3 truth = {RandomRotation(random), RandomPoint(random, 0.0, 3.0)};
    const Triple points = {
        RandomPoint(random, 1, 10), RandomPoint(random, 1, 10), RandomPoint(random, 1, 10)};
    const auto poses = SolveP3p(BearingsOf(truth, points), points);
    ASSERT_GE(poses.size(), 1U) << trial;
    num_exact += DistanceToNearest(truth, poses) < 1e-6 ? 1 : 0;
  }
  EXPECT_GE(num_exact, kTrials - 4);  // the rest are near double solutions
}

TEST(SolveP3p, EveryPoseReprojectsExactlyAndInFront) {
  Random random(2);
  size_t count = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Rigid3 truth = {RandomRotation(random), RandomPoint(random, 0.0, 3.0)};
    const Triple points = {
        RandomPoint(random, 1, 10), RandomPoint(random, 1, 10), RandomPoint(random, 1, 10)};
    const Triple bearings = BearingsOf(truth, points);
    for (const Rigid3& pose : SolveP3p(bearings, points)) {
      ++count;
      for (size_t i = 0; i < 3; ++i)
        EXPECT_LT(AngleBetween(bearings[i], pose * points[i]), 1e-5) << trial;
    }
  }
  EXPECT_GT(count, 500U);
}

TEST(SolveP3p, SolvesSymmetricTriangles) {
  // Equilateral, seen from its axis: conics of the pencil coincide in rank.
  const Triple points = {
      Vector3d(1, 0, 0), Vector3d(-0.5, std::sqrt(0.75), 0), Vector3d(-0.5, -std::sqrt(0.75), 0)};
  for (const Vector3d& centre :
       {Vector3d(0, 0, -2), Vector3d(0, 0, -0.3), Vector3d(0.3, 0, -2), Vector3d(0, 0.4, 1)}) {
    const Rigid3 truth = Rigid3::FromCentre(RotationFromVector({0.3, -1.0, 2.0}), centre);
    EXPECT_LT(DistanceToNearest(truth, SolveP3p(BearingsOf(truth, points), points)), 1e-6)
        << centre.transpose();
  }
}

TEST(SolveP3p, HasNoAnswerForCollinearOrEqualPoints) {
  const Triple bearings = {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  EXPECT_TRUE(
      SolveP3p(bearings, Triple{Vector3d(1, 1, 1), Vector3d(2, 2, 2), Vector3d(3, 3, 3)}).empty());
  EXPECT_TRUE(
      SolveP3p(bearings, Triple{Vector3d(1, 1, 1), Vector3d(1, 1, 1), Vector3d(0, 3, 3)}).empty());
}

TEST(SolveP3p, GivesOnlyFinitePosesForDegenerateBearings) {
  const Triple points = {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)};
  for (const Triple& bearings :
       {Triple{Vector3d::UnitX(), Vector3d::UnitX(), Vector3d::UnitX()},
        Triple{Vector3d::UnitX(), Vector3d::UnitX(), Vector3d::UnitY()},
        Triple{Vector3d::UnitX(), -Vector3d::UnitX(), Vector3d::UnitY()}}) {
    for (const Rigid3& pose : SolveP3p(bearings, points)) {
      EXPECT_TRUE(pose.translation.allFinite());
      EXPECT_NEAR(pose.rotation.norm(), 1.0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace orbweave
