// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/ray_maps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::BearingOf;
using testing::RandomDirection;
using testing::RandomRotation;

TEST(FitRayRotation, RecoversTheRotation) {
  Random random(1);
  for (const size_t count : {2, 3, 50}) {
    const Matrix3d R = RandomRotation(random).toRotationMatrix();
    std::vector<Vector3d> a(count);
    for (Vector3d& bearing : a) bearing = RandomDirection(random);
    std::vector<Vector3d> b(count);
    std::transform(a.begin(), a.end(), b.begin(), [&](const Vector3d& v) { return R * v; });
    const auto found = FitRayRotation(a, b);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT((*found - R).norm(), 1e-9) << count;
  }
}

TEST(FitRayRotation, RefusesParallelBearings) {
  const std::vector<Vector3d> parallel = {Vector3d::UnitX(), -Vector3d::UnitX(), Vector3d::UnitX()};
  EXPECT_FALSE(FitRayRotation(parallel, parallel).has_value());
  EXPECT_FALSE(FitRayRotation({}, {}).has_value());
}

TEST(FitRayHomography, MapsBearingsOfOnePlane) {
  Random random(2);
  const Rigid3 b_from_a = {RandomRotation(random), RandomDirection(random)};
  const Eigen::Quaterniond facing = RandomRotation(random);
  for (const size_t count : {4, 5, 40}) {
    std::vector<Vector3d> a;
    std::vector<Vector3d> b;
    for (size_t i = 0; i < count; ++i) {
      const double x = random.Uniform(-6.0, 6.0);
      const double y = random.Uniform(-6.0, 6.0);
      const Vector3d X = facing * Vector3d(x, y, 3.0);
      a.push_back(X.normalized());
      b.push_back(BearingOf(b_from_a, X));
    }
    const auto H = FitRayHomography(a, b);
    ASSERT_TRUE(H.has_value());
    for (size_t i = 0; i < count; ++i) EXPECT_LT(AngleBetween(*H * a[i], b[i]), 1e-6) << count;
  }
}

TEST(FitRayHomography, OfFourIsThatOfMoreOnTheSamePlane) {
  Random random(7);
  for (int trial = 0; trial < 20; ++trial) {
    Matrix3d H = RandomRotation(random).toRotationMatrix();
    H += 0.3 * RandomDirection(random) * RandomDirection(random).transpose();
    std::vector<Vector3d> a(12);
    std::vector<Vector3d> b(12);
    for (size_t i = 0; i < a.size(); ++i) {
      a[i] = RandomDirection(random);
      b[i] = (H * a[i]).normalized();
    }
    const auto of_all = FitRayHomography(a, b);
    const auto of_four = FitRayHomography(std::span(a).first(4), std::span(b).first(4));
    ASSERT_TRUE(of_all.has_value() && of_four.has_value());
    for (size_t i = 0; i < a.size(); ++i)
      EXPECT_LT(AngleBetween(*of_all * a[i], *of_four * a[i]), 1e-6);
  }
}

TEST(FitRayHomography, RefusesFourOfWhichOneIsSeenFromBehind) {
  Random random(8);
  std::vector<Vector3d> a(4);
  for (Vector3d& bearing : a) bearing = RandomDirection(random);
  std::vector<Vector3d> b = a;
  ASSERT_TRUE(FitRayHomography(a, b).has_value());
  b[2] = -b[2];
  EXPECT_FALSE(FitRayHomography(a, b).has_value());
}

TEST(FitRayHomography, RefusesFewAndCollinearBearings) {
  const auto world = testing::MakeTwoViewWorld(1, 3);
  EXPECT_FALSE(FitRayHomography(world.bearings_a, world.bearings_b).has_value());
  std::vector<Vector3d> on_a_circle;
  for (const double angle : {0.1, 0.7, 1.5, 2.0, 4.0})
    on_a_circle.push_back({std::cos(angle), std::sin(angle), 0.0});
  EXPECT_FALSE(FitRayHomography(on_a_circle, on_a_circle).has_value());
  const auto four = std::span(on_a_circle).first(4);
  EXPECT_FALSE(FitRayHomography(four, four).has_value());
}

/// Three points and more of a plane, seen under a random pose.
TEST(FitRayPlane, RecoversThePlane) {
  Random random(3);
  for (const size_t count : {3, 4, 40}) {
    for (int trial = 0; trial < 20; ++trial) {
      const Rigid3 b_from_a{RandomRotation(random), RandomDirection(random)};
      const Vector3d n = random.Uniform(0.1, 0.5) * RandomDirection(random);
      std::vector<Vector3d> a;
      std::vector<Vector3d> b;
      while (a.size() < count) {
        const Vector3d bearing = RandomDirection(random);
        if (bearing.dot(n.normalized()) < 0.2) continue;
        a.push_back(bearing);
        b.push_back(BearingOf(b_from_a, bearing / bearing.dot(n)));
      }
      const auto found = FitRayPlane(b_from_a, a, b);
      ASSERT_TRUE(found.has_value());
      const Matrix3d truth =
          b_from_a.rotation.toRotationMatrix() + b_from_a.translation * n.transpose();
      EXPECT_LT((*found - truth).norm(), 1e-6) << count;
    }
  }
}

TEST(FitRayPlane, RefusesWhatDeterminesNoneOrLiesBehind) {
  Random random(4);
  const Rigid3 b_from_a{RandomRotation(random), Vector3d(0.5, 0.2, 0.0)};
  const std::vector<Vector3d> in_line = {
      Vector3d(1.0, 0.0, 4.0), Vector3d(2.0, 0.0, 5.0), Vector3d(3.0, 0.0, 6.0)};
  const std::vector<Vector3d> in_plane = {
      Vector3d(1.0, 0.0, 4.0), Vector3d(2.0, 1.0, 4.0), Vector3d(-3.0, 2.0, 4.0)};
  const auto fit = [&](const std::vector<Vector3d>& points, double side) {
    std::vector<Vector3d> a;
    std::vector<Vector3d> b;
    for (const Vector3d& point : points) {
      a.push_back(side * point.normalized());
      b.push_back(BearingOf(b_from_a, point));
    }
    return FitRayPlane(b_from_a, a, b);
  };
  EXPECT_TRUE(fit(in_plane, 1.0).has_value());
  EXPECT_FALSE(fit(in_line, 1.0).has_value());
  EXPECT_FALSE(fit(in_plane, -1.0).has_value());
  EXPECT_FALSE(fit({in_plane[0], in_plane[1]}, 1.0).has_value());
}

}  // namespace
}  // namespace orbweave
