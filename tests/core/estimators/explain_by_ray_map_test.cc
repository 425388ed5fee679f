// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/explain_by_ray_map.h"

#include <gtest/gtest.h>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::MakeTwoViewWorld;
using testing::TwoViewWorld;
using testing::WithNoise;

constexpr double kMaxErrorRad = 4.7e-3;
constexpr double kSigmaRad = 1e-3;

BearingPairs Arrange(const TwoViewWorld& world) {
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0; i < world.bearings_a.size(); ++i) matches.push_back({i, i});
  return ArrangePairs(world.bearings_a, world.bearings_b, matches, 1);
}

TEST(ExplainByRotation, HoldsForATurnedPanorama) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    TwoViewWorld world = MakeTwoViewWorld(seed, 200);
    Random random(seed);
    for (size_t i = 10; i < 200; ++i) {
      world.bearings_b[i] =
          WithNoise(random, world.b_from_a.rotation * world.bearings_a[i], kSigmaRad);
    }
    const auto map = ExplainByRotation(Arrange(world), kMaxErrorRad, 0.9, {.seed = seed});
    ASSERT_TRUE(map.ok());
    EXPECT_GE(map->inliers.size(), 185U) << seed;
    EXPECT_LT((map->M - world.b_from_a.rotation.toRotationMatrix()).norm(), 1e-3) << seed;
  }
}

TEST(ExplainByRotation, FailsForAMovedPanorama) {
  const auto map =
      ExplainByRotation(Arrange(MakeTwoViewWorld(1, 200)), kMaxErrorRad, 0.9, {.seed = 1});
  ASSERT_TRUE(map.ok());
  EXPECT_LT(map->inliers.size(), 40U);
}

TEST(ExplainByHomography, HoldsForAPlaneAndFailsForAScene) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    TwoViewWorld world = MakeTwoViewWorld(seed, 200);
    const auto scene = ExplainByHomography(Arrange(world), kMaxErrorRad, 0.9, {.seed = seed});
    ASSERT_TRUE(scene.ok());
    EXPECT_LT(scene->inliers.size(), 100U) << seed;
    Random random(seed);
    for (size_t i = 0; i < 200; ++i) {
      const Vector3d X(2.0 * world.points_in_a[i].x(), 2.0 * world.points_in_a[i].y(), 4.0);
      world.bearings_a[i] = WithNoise(random, X.normalized(), 0.3 * kSigmaRad);
      world.bearings_b[i] =
          WithNoise(random, testing::BearingOf(world.b_from_a, X), 0.3 * kSigmaRad);
    }
    const auto plane = ExplainByHomography(Arrange(world), kMaxErrorRad, 0.9, {.seed = seed});
    ASSERT_TRUE(plane.ok());
    EXPECT_GE(plane->inliers.size(), 195U) << seed;
  }
}

TEST(ExplainByPlane, FindsAFacadeOfTwoFifthsAndNoneInAScene) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    TwoViewWorld world = MakeTwoViewWorld(seed, 200);
    const auto explain = [&] {
      return ExplainByPlane(Arrange(world), world.b_from_a, kMaxErrorRad, 0.4, {.seed = seed});
    };
    const auto scene = explain();
    ASSERT_TRUE(scene.ok());
    EXPECT_LT(scene->inliers.size(), 80U) << seed;
    Random random(seed);
    for (size_t i = 0; i < 90; ++i) {
      const Vector3d X(2.0 * world.points_in_a[i].x(), 2.0 * world.points_in_a[i].y(), 4.0);
      world.bearings_a[i] = WithNoise(random, X.normalized(), kSigmaRad);
      world.bearings_b[i] = WithNoise(random, testing::BearingOf(world.b_from_a, X), kSigmaRad);
    }
    const auto plane = explain();
    ASSERT_TRUE(plane.ok());
    EXPECT_GE(plane->inliers.size(), 85U) << seed;
  }
}

TEST(ExplainByRotation, ExplainsNothingWithoutData) {
  const auto map = ExplainByRotation({}, kMaxErrorRad, 0.9, {});
  ASSERT_TRUE(map.ok());
  EXPECT_TRUE(map->inliers.empty());
}

}  // namespace
}  // namespace orbweave
