// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/match_evidence.h"

#include <gtest/gtest.h>

#include <numeric>

#include "core/estimators/estimate_two_view.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using testing::MakeTwoViewWorld;
using testing::RandomDirection;
using testing::RandomRotation;
using testing::TwoViewWorld;

constexpr double kMaxErrorRad = 4.0 * 2.0 * std::numbers::pi / 2048.0;

BearingPairs PairsOf(const std::vector<Eigen::Vector3d>& a,
                     const std::vector<Eigen::Vector3d>& b,
                     uint64_t seed) {
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0; i < a.size(); ++i) matches.push_back({i, i});
  return ArrangePairs(a, b, matches, seed);
}

BearingPairs PairsOf(const TwoViewWorld& world) {
  return PairsOf(world.bearings_a, world.bearings_b, 1);
}

TEST(EvidenceOf, IsStrongForFewInliersAmongManyMatches) {
  // 20 of 200: a tenth.
  const TwoViewWorld world = MakeTwoViewWorld(3, 200, 0.9, 5e-4);
  const MatchEvidence evidence = EvidenceOf(PairsOf(world), world.b_from_a, kMaxErrorRad);
  EXPECT_LT(evidence.log10_false_alarms, -4.0);
  EXPECT_GE(evidence.num_inliers, 18U);
}

TEST(EvidenceOf, TellsTheBestPoseOfWrongMatchesFromARightOne) {
  // What RANSAC finds where there is nothing to find: at most one in a hundred may pass.
  int accepted = 0;
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    const TwoViewWorld world = MakeTwoViewWorld(seed, 40, 1.0);
    std::vector<FeatureMatch> matches;
    for (uint32_t i = 0; i < 40; ++i) matches.push_back({i, i});
    const auto geometry = EstimateTwoView({ImageId(0), ImageId(1)},
                                          world.bearings_a,
                                          world.bearings_b,
                                          matches,
                                          kMaxErrorRad,
                                          {},
                                          {.seed = seed});
    ASSERT_TRUE(geometry.ok());
    accepted += geometry->kind == TwoViewKind::kNone ? 0 : 1;
  }
  EXPECT_LE(accepted, 1);
}

TEST(EvidenceOf, IsNotConvincedByACarThatFollows) {
  // One thing of 5 degrees, at the same distance in both panoramas, amid wrong matches.
  Random random(7);
  TwoViewWorld world = MakeTwoViewWorld(5, 25, 1.0);
  const Rigid3 car_b_from_a = {RandomRotation(random), RandomDirection(random)};
  const Eigen::Vector3d car = testing::RandomPoint(random, 10.0, 10.0);
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d part = car + testing::RandomPoint(random, 0.0, 0.5);
    world.bearings_a.push_back(part.normalized());
    world.bearings_b.push_back(testing::BearingOf(car_b_from_a, part));
  }
  const MatchEvidence evidence = EvidenceOf(PairsOf(world), car_b_from_a, kMaxErrorRad);
  EXPECT_LE(evidence.num_matches, 30U);
  EXPECT_GT(evidence.log10_false_alarms, -1.0);
}

TEST(EvidenceOf, GivesNoCreditForLyingOnTheHorizon) {
  // Wrong matches of features that all lie on one great circle fit every pose with that plane.
  Random random(11);
  std::vector<Eigen::Vector3d> a;
  std::vector<Eigen::Vector3d> b;
  for (int i = 0; i < 80; ++i) {
    const double x = random.Uniform(-3.14, 3.14);
    const double y = random.Uniform(-3.14, 3.14);
    a.emplace_back(std::sin(x), 0.0, std::cos(x));
    b.emplace_back(std::sin(y), 0.0, std::cos(y));
  }
  const Rigid3 pose{Eigen::Quaterniond::Identity(), Eigen::Vector3d::UnitZ()};
  EXPECT_GT(EvidenceOf(PairsOf(a, b, 1), pose, kMaxErrorRad).log10_false_alarms, -2.0);
}

TEST(EvidenceOf, IsAbsorbedByTurningEachPanorama) {
  const TwoViewWorld world = MakeTwoViewWorld(9, 120, 0.5, 5e-4);
  Random random(13);
  const Eigen::Quaterniond turn_a = RandomRotation(random);
  const Eigen::Quaterniond turn_b = RandomRotation(random);
  TwoViewWorld turned = world;
  for (Eigen::Vector3d& bearing : turned.bearings_a) bearing = turn_a * bearing;
  for (Eigen::Vector3d& bearing : turned.bearings_b) bearing = turn_b * bearing;
  const Rigid3 pose{turn_b * world.b_from_a.rotation * turn_a.conjugate(),
                    turn_b * world.b_from_a.translation};
  const MatchEvidence before = EvidenceOf(PairsOf(world), world.b_from_a, kMaxErrorRad);
  const MatchEvidence after = EvidenceOf(PairsOf(turned), pose, kMaxErrorRad);
  EXPECT_EQ(after.num_inliers, before.num_inliers);
  EXPECT_NEAR(after.log10_false_alarms, before.log10_false_alarms, 1e-9);
}

TEST(EvidenceOf, KnowsPureRotations) {
  TwoViewWorld world = MakeTwoViewWorld(15, 100, 0.8);
  for (size_t i = world.num_outliers; i < 100; ++i)
    world.bearings_b[i] = world.b_from_a.rotation * world.bearings_a[i];
  const Rigid3 rotation{world.b_from_a.rotation, Eigen::Vector3d::Zero()};
  EXPECT_LT(EvidenceOf(PairsOf(world), rotation, kMaxErrorRad).log10_false_alarms, -20.0);
  const Rigid3 other{Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero()};
  EXPECT_GE(EvidenceOf(PairsOf(world), other, kMaxErrorRad).log10_false_alarms, 0.0);
}

TEST(EvidenceOf, IsNoneForAHandfulOfMatches) {
  const TwoViewWorld world = MakeTwoViewWorld(17, 5);
  EXPECT_EQ(EvidenceOf(PairsOf(world), world.b_from_a, kMaxErrorRad).log10_false_alarms, 0.0);
  EXPECT_EQ(EvidenceOf({}, world.b_from_a, kMaxErrorRad).log10_false_alarms, 0.0);
}

TEST(SmallestTellingShare, FallsAsMatchesGrow) {
  double last = 1.0;
  for (const size_t n : {10U, 30U, 100U, 1000U}) {
    const double share = SmallestTellingShare(n, kMaxErrorRad, -4.0);
    EXPECT_LT(share, last) << n;
    last = share;
  }
  EXPECT_EQ(SmallestTellingShare(3, kMaxErrorRad, -4.0), 1.0);
}

}  // namespace
}  // namespace orbweave
