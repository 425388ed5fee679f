// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/triangulate_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::BearingOf;
using testing::MakeTrackWorld;
using testing::RandomDirection;
using testing::RandomRotation;
using testing::TrackWorld;

double SumOfSquaredSines(const TrackWorld& world, const Vector3d& X) {
  double sum = 0.0;
  for (size_t i = 0; i < world.bearings.size(); ++i) {
    sum += world.bearings[i].cross(BearingOf(world.cams_from_world[i], X)).squaredNorm();
  }
  return sum;
}

TEST(TriangulateRays, RecoversThePointOfCleanRays) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const TrackWorld world = MakeTrackWorld(seed, 2 + seed % 9);
    const auto X = TriangulateRays(world.cams_from_world, world.bearings);
    ASSERT_TRUE(X.has_value()) << seed;
    EXPECT_LT((*X - world.point_in_world).norm(), 1e-9) << seed;
  }
}

TEST(TriangulateRays, RecoversPointBehindTheCamera) {
  // Behind, at the seam, above and below: directions where a pinhole or the pixel grid ends.
  for (const Vector3d& X :
       {Vector3d(0, 0, -5), Vector3d(1e-9, 0, -5), Vector3d(0, -5, 0), Vector3d(0, 5, 0)}) {
    const std::vector<Rigid3> cams = {
        Rigid3{}, Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {1, 0.2, 0.1})};
    const std::vector<Vector3d> bearings = {BearingOf(cams[0], X), BearingOf(cams[1], X)};
    const auto found = TriangulateRays(cams, bearings);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT((*found - X).norm(), 1e-9);
  }
}

TEST(TriangulateRays, DoesNotDependOnTheRotationOfACamera) {
  Random random(7);
  TrackWorld world = MakeTrackWorld(3, 5, 1e-3);
  const auto before = TriangulateRays(world.cams_from_world, world.bearings);
  for (size_t i = 0; i < world.bearings.size(); ++i) {
    const Rigid3 turn = {RandomRotation(random), Vector3d::Zero()};
    world.cams_from_world[i] = turn * world.cams_from_world[i];
    world.bearings[i] = turn.rotation * world.bearings[i];
  }
  const auto after = TriangulateRays(world.cams_from_world, world.bearings);
  ASSERT_TRUE(before && after);
  EXPECT_LT((*before - *after).norm(), 1e-9);
}

TEST(TriangulateRays, LosesNoDigitsFarFromTheOrigin) {
  TrackWorld world = MakeTrackWorld(5, 4, 1e-3);
  const auto near = TriangulateRays(world.cams_from_world, world.bearings);
  const Vector3d shift(4e5, 5e6, 300);  // a projected national grid
  for (Rigid3& cam : world.cams_from_world)
    cam = Rigid3::FromCentre(cam.rotation, cam.Centre() + shift);
  const auto far = TriangulateRays(world.cams_from_world, world.bearings);
  ASSERT_TRUE(near && far);
  EXPECT_LT((*near + shift - *far).norm(), 1e-6);
}

TEST(TriangulateRays, MinimisesTheAngularError) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const TrackWorld world = MakeTrackWorld(seed, 4, 5e-3);
    const auto X = TriangulateRays(world.cams_from_world, world.bearings);
    ASSERT_TRUE(X.has_value());
    const double least = SumOfSquaredSines(world, *X);
    for (int k = 0; k < 3; ++k) {
      for (const double step : {-1e-4, 1e-4}) {
        EXPECT_GT(SumOfSquaredSines(world, *X + step * Vector3d::Unit(k)), least);
      }
    }
  }
}

TEST(TriangulateRays, RefusesParallelOppositeAndSingleRays) {
  const std::vector<Rigid3> cams = {Rigid3{},
                                    Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {1, 0, 0})};
  const Vector3d z = Vector3d::UnitZ();
  const Vector3d x = Vector3d::UnitX();
  EXPECT_FALSE(TriangulateRays(cams, std::vector<Vector3d>{z, z}).has_value());
  EXPECT_FALSE(TriangulateRays(cams, std::vector<Vector3d>{x, -x}).has_value());
  EXPECT_FALSE(TriangulateRays({}, {}).has_value());
  EXPECT_FALSE(TriangulateRays(std::span(cams).first(1), std::vector<Vector3d>{z}).has_value());
}

TEST(TriangulateRays, RefusesAPointBehindARay) {
  const std::vector<Rigid3> cams = {Rigid3{},
                                    Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {1, 0, 0})};
  const std::vector<Vector3d> diverging = {Vector3d(-0.1, 0, 1).normalized(),
                                           Vector3d(0.1, 0, 1).normalized()};
  EXPECT_FALSE(TriangulateRays(cams, diverging).has_value());
}

TEST(TriangulateRays, RefusesRaysFromOneCentre) {
  const std::vector<Rigid3> cams(2, Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {3, 1, 2}));
  const std::vector<Vector3d> bearings = {Vector3d::UnitX(), Vector3d::UnitZ()};
  EXPECT_FALSE(TriangulateRays(cams, bearings).has_value());
}

TEST(RangeGap, IsOfTheTwoNearest) {
  const std::vector<Vector3d> centres = {{8, 0, 0}, {0, 2, 0}, {0, 0, -100}};
  EXPECT_DOUBLE_EQ(RangeGap(Vector3d::Zero(), centres), 4.0);
  EXPECT_EQ(RangeGap(Vector3d::Zero(), std::span(centres).first(1)), 1.0);
  EXPECT_EQ(RangeGap(centres[0], centres), std::numeric_limits<double>::infinity());
}

TEST(MaxTriangulationAngle, IsTheWidestOfAllPairs) {
  const std::vector<Vector3d> centres = {{1, 0, 0}, {1, 1, 0}, {-1, 1e-9, 0}};
  EXPECT_NEAR(MaxTriangulationAngle(Vector3d::Zero(), centres), std::numbers::pi, 1e-6);
  EXPECT_NEAR(MaxTriangulationAngle(Vector3d::Zero(), std::span(centres).first(2)),
              std::numbers::pi / 4,
              1e-12);
  EXPECT_EQ(MaxTriangulationAngle(Vector3d::Zero(), std::span(centres).first(1)), 0.0);
}

TEST(TriangulateRobustly, FindsTheInliersAmongWrongRays) {
  for (const size_t count : {5, 8, 12, 40}) {
    for (uint64_t seed = 0; seed < 20; ++seed) {
      TrackWorld world = MakeTrackWorld(seed, count, 5e-4);
      Random random(seed + 100);
      const size_t num_wrong = count * 2 / 5;
      for (size_t i = 0; i < num_wrong; ++i) world.bearings[i * 2] = RandomDirection(random);
      const auto found = TriangulateRobustly(world.cams_from_world, world.bearings, 3e-3, 0.02);
      ASSERT_TRUE(found.has_value()) << count << " rays, seed " << seed;
      EXPECT_LT((found->point_in_world - world.point_in_world).norm(), 0.05);
      EXPECT_EQ(found->num_inliers, count - num_wrong) << count << " rays, seed " << seed;
      EXPECT_EQ(std::count(found->is_inlier.begin(), found->is_inlier.end(), 1),
                found->num_inliers);
    }
  }
}

TEST(TriangulateRobustly, KeepsAllCleanRays) {
  const TrackWorld world = MakeTrackWorld(1, 6, 5e-4);
  const auto found = TriangulateRobustly(world.cams_from_world, world.bearings, 4e-3, 0.02);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->num_inliers, 6U);
}

TEST(TriangulateRobustly, RefusesSmallAngles) {
  const Vector3d X(0, 0, 100);
  const std::vector<Rigid3> cams = {Rigid3{},
                                    Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {1, 0, 0})};
  const std::vector<Vector3d> bearings = {BearingOf(cams[0], X), BearingOf(cams[1], X)};
  EXPECT_TRUE(TriangulateRobustly(cams, bearings, 1e-3, 0.009).has_value());
  EXPECT_FALSE(TriangulateRobustly(cams, bearings, 1e-3, 0.011).has_value());
}

TEST(TriangulateRobustly, RefusesRaysThatDoNotMeet) {
  const std::vector<Rigid3> cams = {Rigid3{},
                                    Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {1, 0, 0})};
  const std::vector<Vector3d> bearings = {Vector3d::UnitZ(), Vector3d(-0.1, 0.5, 1).normalized()};
  EXPECT_FALSE(TriangulateRobustly(cams, bearings, 1e-3, 0.01).has_value());
  EXPECT_FALSE(TriangulateRobustly({}, {}, 1e-3, 0.01).has_value());
}

}  // namespace
}  // namespace orbweave
