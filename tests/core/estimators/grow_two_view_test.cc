// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/grow_two_view.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/estimators/estimate_two_view.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::BearingOf;
using testing::MakeTwoViewWorld;
using testing::RandomDirection;
using testing::RotationError;
using testing::TwoViewWorld;
using testing::WithNoise;

constexpr double kSigmaRad = 1e-3;
constexpr double kMaxErrorRad = 4.7e-3;
const ImagePair kPair = {ImageId(3), ImageId(7)};

std::vector<FeatureMatch> Matches(uint32_t begin, uint32_t end) {
  std::vector<FeatureMatch> matches;
  for (uint32_t i = begin; i < end; ++i) matches.push_back({i, i});
  return matches;
}

TwoViewGeometry Estimate(const TwoViewWorld& world, const std::vector<FeatureMatch>& matches) {
  const auto geometry = EstimateTwoView(
      kPair, world.bearings_a, world.bearings_b, matches, kMaxErrorRad, {}, {.seed = 1});
  EXPECT_TRUE(geometry.ok()) << geometry.status();
  return *geometry;
}

TwoViewGeometry Grow(const TwoViewGeometry& geometry,
                     const TwoViewWorld& world,
                     const std::vector<FeatureMatch>& matches) {
  return GrowTwoView(geometry, world.bearings_a, world.bearings_b, matches, kMaxErrorRad, 1);
}

double DirectionError(const TwoViewGeometry& geometry, const TwoViewWorld& world) {
  return AngleBetween(geometry.b_from_a.translation, world.b_from_a.translation);
}

/// A camera that drives straight on, hardly turned, between points all round.
TwoViewWorld MakeDrive(uint64_t seed, size_t count) {
  TwoViewWorld world = MakeTwoViewWorld(seed, count);
  world.b_from_a.rotation = RotationFromVector({0.0004, 0.0002, -0.0003});
  Random random(seed + 1);
  for (size_t i = 0; i < count; ++i) {
    world.bearings_b[i] =
        WithNoise(random, BearingOf(world.b_from_a, world.points_in_a[i]), kSigmaRad);
  }
  return world;
}

TEST(GrowTwoView, MoreMatchesMakeThePoseBetter) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const TwoViewWorld world = MakeTwoViewWorld(seed, 2000, 0.0, kSigmaRad);
    const TwoViewGeometry few = Estimate(world, Matches(0, 40));
    const TwoViewGeometry all = Grow(few, world, Matches(0, 2000));
    EXPECT_GT(all.inliers.size(), 1950U) << seed;
    EXPECT_TRUE(std::ranges::is_sorted(all.inliers));
    EXPECT_LT(RotationError(all.b_from_a.rotation, world.b_from_a.rotation), 2e-4) << seed;
    EXPECT_LT(DirectionError(all, world), 1e-3) << seed;
    EXPECT_LT(RotationError(all.b_from_a.rotation, world.b_from_a.rotation),
              RotationError(few.b_from_a.rotation, world.b_from_a.rotation) + 1e-5);
    EXPECT_EQ(all.kind, few.kind);
    EXPECT_EQ(all.log10_false_alarms, few.log10_false_alarms);
  }
}

TEST(GrowTwoView, ComesFromAPoseThatIsOffByTheWidthOfThePlanes) {
  const TwoViewWorld world = MakeTwoViewWorld(7, 2000, 0.0, kSigmaRad);
  TwoViewGeometry off = Estimate(world, Matches(0, 100));
  off.b_from_a.rotation =
      RotationFromVector({kMaxErrorRad, -kMaxErrorRad, 0.0}) * off.b_from_a.rotation;
  const TwoViewGeometry grown = Grow(off, world, Matches(0, 2000));
  EXPECT_LT(RotationError(grown.b_from_a.rotation, world.b_from_a.rotation), 2e-4);
  EXPECT_GT(grown.inliers.size(), 1950U);
}

TEST(GrowTwoView, StaysWhereMatchesAreNoMore) {
  const TwoViewWorld world = MakeTwoViewWorld(8, 200, 0.0, kSigmaRad);
  const TwoViewGeometry all = Estimate(world, Matches(0, 200));
  const TwoViewGeometry same = Grow(all, world, Matches(0, 20));
  EXPECT_EQ(same.inliers, all.inliers);
  EXPECT_TRUE(same.b_from_a.translation.isApprox(all.b_from_a.translation, 0.0));
}

TEST(GrowTwoView, TheCarrierStaysOut) {
  TwoViewWorld world = MakeDrive(9, 300);
  Random random(77);
  for (int i = 0; i < 400; ++i) {  // within 40 degrees of the nadir, the same in both
    Vector3d spot = RandomDirection(random);
    while (spot.y() < 0.77) spot = RandomDirection(random);
    world.bearings_a.push_back(WithNoise(random, spot, kSigmaRad));
    world.bearings_b.push_back(WithNoise(random, spot, kSigmaRad));
  }
  const TwoViewGeometry scene = Estimate(world, Matches(0, 100));
  const TwoViewGeometry grown = Grow(scene, world, Matches(0, 700));
  EXPECT_GT(grown.inliers.size(), 250U);
  const auto of_carrier = std::ranges::count_if(
      grown.inliers, [](const FeatureMatch& match) { return match.a >= 300; });
  EXPECT_LE(of_carrier, 4);  // noise takes one in 250 as far apart as what has moved
}

TEST(GrowTwoView, CloudsStayOut) {
  TwoViewWorld world = MakeDrive(10, 300);
  Random random(78);
  const Vector3d along = world.b_from_a.translation;
  for (int i = 0; i < 400; ++i) {  // they drift with the camera's own motion: on its planes
    const Vector3d cloud = 40.0 * Vector3d(random.Uniform(-1, 1), -1.0, random.Uniform(-1, 1));
    world.bearings_a.push_back(cloud.normalized());
    world.bearings_b.push_back((world.b_from_a.rotation * cloud + 0.5 * along).normalized());
  }
  const TwoViewGeometry scene = Estimate(world, Matches(0, 100));
  const TwoViewGeometry grown = Grow(scene, world, Matches(0, 700));
  EXPECT_GT(grown.inliers.size(), 250U);
  for (const FeatureMatch& match : grown.inliers) EXPECT_LT(match.a, 300U);
}

}  // namespace
}  // namespace orbweave
