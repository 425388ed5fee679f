// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/epipolar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/geometry/essential.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::MakeTwoViewWorld;
using testing::RandomDirection;
using testing::WithNoise;

/// Translation along x, no rotation: the epipolar planes hold the x axis.
const Rigid3 kSideways = {Eigen::Quaterniond::Identity(), Vector3d::UnitX()};

TEST(EpipolarAngle, IsTheAngleToThePlane) {
  const Eigen::Matrix3d E = EssentialFromPose(kSideways);
  for (const double angle : {0.0, 1e-6, 0.1, 1.5}) {
    // p_a anywhere in the plane y = 0; p_b lifted off that plane by the angle.
    const Vector3d p_a = Vector3d(0.9, 0.0, 0.1).normalized();
    const Vector3d p_b(0.6 * std::cos(angle), std::sin(angle), -0.8 * std::cos(angle));
    EXPECT_NEAR(EpipolarAngle(E, p_a, p_b), angle, 1e-9);
    EXPECT_NEAR(EpipolarAngle(7.0 * E, p_a, -p_b), angle, 1e-9);
  }
}

TEST(EpipolarAngle, HasNoPlaneAtTheEpipole) {
  EXPECT_EQ(EpipolarAngle(EssentialFromPose(kSideways), Vector3d::UnitX(), Vector3d::UnitY()),
            std::numbers::pi / 2);
}

TEST(SymmetricEpipolarAngle, VanishesForRaysOfAPoint) {
  const auto world = MakeTwoViewWorld(1, 100);
  for (size_t i = 0; i < 100; ++i) {
    EXPECT_LT(SymmetricEpipolarAngle(world.b_from_a, world.bearings_a[i], world.bearings_b[i]),
              1e-10);
  }
}

TEST(SymmetricEpipolarAngle, IsTheSameFromEitherImage) {
  const auto world = MakeTwoViewWorld(2, 100, 1.0);
  for (size_t i = 0; i < 100; ++i) {
    const double forth =
        SymmetricEpipolarAngle(world.b_from_a, world.bearings_a[i], world.bearings_b[i]);
    const double back =
        SymmetricEpipolarAngle(world.b_from_a.Inverse(), world.bearings_b[i], world.bearings_a[i]);
    EXPECT_NEAR(forth, back, 1e-9);
  }
}

TEST(SymmetricEpipolarAngle, LiesBetweenTheAnglesInTheTwoImages) {
  const auto world = MakeTwoViewWorld(3, 100, 1.0);
  const Eigen::Matrix3d E = EssentialFromPose(world.b_from_a);
  for (size_t i = 0; i < 100; ++i) {
    const double in_b = EpipolarAngle(E, world.bearings_a[i], world.bearings_b[i]);
    const double in_a = EpipolarAngle(E.transpose(), world.bearings_b[i], world.bearings_a[i]);
    const double symmetric =
        SymmetricEpipolarAngle(world.b_from_a, world.bearings_a[i], world.bearings_b[i]);
    EXPECT_GE(symmetric, std::min(in_a, in_b) - 1e-12);
    EXPECT_LE(symmetric, std::max(in_a, in_b) + 1e-12);
  }
}

TEST(SymmetricEpipolarAngle, StaysAtTheNoiseLevelNearTheEpipole) {
  Random random(4);
  const double sigma = 1e-3;
  for (const double from_epipole : {0.01, 0.05, 0.3, 1.0}) {
    double sum = 0.0;
    constexpr int kTrials = 4000;
    for (int trial = 0; trial < kTrials; ++trial) {
      const Vector3d p_a(std::cos(from_epipole), std::sin(from_epipole), 0.0);
      const Vector3d p_b(std::cos(3.0 * from_epipole), std::sin(3.0 * from_epipole), 0.0);
      const double e = SymmetricEpipolarAngle(
          kSideways, WithNoise(random, p_a, sigma), WithNoise(random, p_b, sigma));
      sum += e * e;
    }
    EXPECT_NEAR(std::sqrt(sum / kTrials) / sigma, std::sqrt(2.0), 0.1) << from_epipole;
  }
}

TEST(RayPair, IsWithinWhatItsAngleIsWithin) {
  Random random(6);
  const auto world = MakeTwoViewWorld(6, 200);
  const PoseOfRays rays_of(world.b_from_a);
  for (size_t i = 0; i < 200; ++i) {
    const double noise_rad = i % 2 == 0 ? 1e-3 : 0.3;
    const RayPair rays =
        rays_of(world.bearings_a[i], WithNoise(random, world.bearings_b[i], noise_rad));
    const double angle = rays.SymmetricEpipolarAngle();
    for (const double factor : {0.0, 0.5, 0.95, 0.999999, 1.000001, 1.05, 2.0, 1000.0})
      EXPECT_EQ(rays.IsWithin(factor * angle), factor > 1.0) << angle << " times " << factor;
  }
}

TEST(RayPair, HasARightAngleAtBothEpipoles) {
  const RayPair rays = PoseOfRays(kSideways)(Vector3d::UnitX(), Vector3d::UnitX());
  EXPECT_FALSE(rays.IsWithin(1.5));
  EXPECT_TRUE(rays.IsWithin(1.6));
}

TEST(IsInFrontOfBoth, HoldsForPointsInEveryDirection) {
  const auto world = MakeTwoViewWorld(5, 500);
  const Rigid3 wrong_side = {world.b_from_a.rotation, -world.b_from_a.translation};
  for (size_t i = 0; i < 500; ++i) {
    EXPECT_TRUE(IsInFrontOfBoth(world.b_from_a, world.bearings_a[i], world.bearings_b[i]));
    EXPECT_FALSE(IsInFrontOfBoth(wrong_side, world.bearings_a[i], world.bearings_b[i]));
    EXPECT_FALSE(IsInFrontOfBoth(world.b_from_a, -world.bearings_a[i], world.bearings_b[i]));
  }
}

TEST(IsInFrontOfBoth, IsFalseForParallelRays) {
  EXPECT_FALSE(IsInFrontOfBoth(kSideways, Vector3d::UnitZ(), Vector3d::UnitZ()));
}

}  // namespace
}  // namespace orbweave
