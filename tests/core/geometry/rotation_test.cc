// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/rotation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using std::numbers::pi;
using testing::RandomDirection;
using testing::RandomRotation;

TEST(RotationFromVector, IsUndoneByVectorFromRotation) {
  Random random(1);
  for (const double angle : {0.0, 1e-12, 1e-7, 1e-3, 1.0, 3.0, pi - 1e-6}) {
    const Vector3d w = angle * RandomDirection(random);
    EXPECT_LT((VectorFromRotation(RotationFromVector(w)) - w).norm(), 1e-9) << angle;
    EXPECT_NEAR(RotationAngle(RotationFromVector(w)), angle, 1e-9);
  }
}

TEST(RotationFromVector, AgreesWithEigen) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector3d axis = RandomDirection(random);
    const double angle = random.Uniform(0.0, 10.0);
    const Quaterniond expected(Eigen::AngleAxisd(angle, axis));
    EXPECT_LT(RotationAngle(RotationFromVector(angle * axis) * expected.conjugate()), 1e-9);
  }
}

TEST(VectorFromRotation, TakesTheShortWayForEitherSign) {
  const Quaterniond q = RotationFromVector({0.1, -0.2, 0.3});
  const Quaterniond negated(-q.w(), -q.x(), -q.y(), -q.z());
  EXPECT_LT((VectorFromRotation(q) - VectorFromRotation(negated)).norm(), 1e-15);
}

TEST(RotationBetween, TakesTheShortestWay) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector3d from = 3.0 * RandomDirection(random);
    const Vector3d to = 0.5 * RandomDirection(random);
    const Quaterniond rotation = RotationBetween(from, to);
    EXPECT_LT((rotation * from.normalized() - to.normalized()).norm(), 1e-12);
    EXPECT_NEAR(RotationAngle(rotation), AngleBetween(from, to), 1e-9);
  }
}

TEST(RotationBetween, TurnsOppositeVectorsByHalfATurn) {
  const Vector3d from(0.0, 1.0, 0.0);
  const Quaterniond rotation = RotationBetween(from, -from);
  EXPECT_LT((rotation * from + from).norm(), 1e-7);
  EXPECT_NEAR(RotationAngle(rotation), pi, 1e-7);
}

TEST(SkewSymmetric, IsTheCrossProduct) {
  const Vector3d v(1, -2, 3);
  const Vector3d w(0.4, 5, -6);
  EXPECT_LT((SkewSymmetric(v) * w - v.cross(w)).norm(), 1e-15);
}

TEST(TangentBasis, IsOrthonormalEverywhere) {
  Random random(3);
  const auto expect_orthonormal = [](const Vector3d& b) {
    Eigen::Matrix3d frame;
    frame << TangentBasis(b), b;
    EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-12)
        << b.transpose();
  };
  for (int trial = 0; trial < 1000; ++trial) expect_orthonormal(RandomDirection(random));
  for (int k = 0; k < 3; ++k) {
    expect_orthonormal(Vector3d::Unit(k));
    expect_orthonormal(-Vector3d::Unit(k));
  }
}

TEST(AngleBetween, IsAccurateForTinyAndFlatAngles) {
  const Vector3d x = Vector3d::UnitX();
  for (const double angle : {1e-12, 1e-8, 1e-3, 1.0}) {
    EXPECT_NEAR(
        AngleBetween(x, Vector3d(std::cos(angle), std::sin(angle), 0.0)) / angle, 1.0, 1e-9);
    EXPECT_NEAR((pi - AngleBetween(x, Vector3d(-std::cos(angle), std::sin(angle), 0.0))) / angle,
                1.0,
                1e-3);
  }
}

TEST(IsWithinAngle, IsWhatTheAngleSays) {
  Random random(7);
  for (int trial = 0; trial < 20'000; ++trial) {
    const Vector3d a = 3.0 * RandomDirection(random);
    const double max_rad = std::pow(10.0, random.Uniform(-6.0, 0.5));
    const double angle_rad = std::min(pi, max_rad * random.Uniform(0.2, 2.2));
    const Vector3d across = TangentBasis(a.normalized()) * Eigen::Vector2d(0.6, -0.8);
    const Vector3d b = Eigen::AngleAxisd(angle_rad, across) * a / 7.0;
    EXPECT_EQ(IsWithinAngle(a, b, max_rad), AngleBetween(a, b) <= max_rad)
        << angle_rad << " " << max_rad;
  }
}

TEST(IsWithinAngle, HoldsOfNothingThatIsNoNumber) {
  const Vector3d nowhere = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(IsWithinAngle(nowhere, Vector3d::UnitX(), 1.0));
  EXPECT_FALSE(IsWithinAngle(Vector3d::UnitX(), nowhere, 1.0));
}

}  // namespace
}  // namespace orbweave
