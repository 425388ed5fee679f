// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/bearing_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/epipolar.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using testing::MakeTwoViewWorld;
using testing::TwoViewWorld;

constexpr double kMaxErrorRad = 0.05;

BearingPairs Arrange(const TwoViewWorld& world, uint64_t seed = 1) {
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0; i < world.bearings_a.size(); ++i) matches.push_back({i, i});
  return ArrangePairs(world.bearings_a, world.bearings_b, matches, seed);
}

TEST(ArrangePairs, KeepsEveryMatchOnceUnderItsIndex) {
  const TwoViewWorld world = MakeTwoViewWorld(1, 50);
  const BearingPairs pairs = Arrange(world);
  std::vector<uint32_t> order = pairs.order;
  for (size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(pairs.A(i), world.bearings_a[order[i]]);
    EXPECT_EQ(pairs.B(i), world.bearings_b[order[i]]);
  }
  std::sort(order.begin(), order.end());
  EXPECT_TRUE(std::unique(order.begin(), order.end()) == order.end());
}

TEST(ScoreEpipolar, AgreesWithTheAngleOfEachPair) {
  const TwoViewWorld world = MakeTwoViewWorld(2, 333, 0.5, 0.01);
  const BearingPairs pairs = Arrange(world);
  const auto score = ScoreEpipolar(pairs, world.b_from_a, kMaxErrorRad, EarlyRejection(333));
  ASSERT_TRUE(score.has_value());
  double cost = 0.0;
  std::vector<uint32_t> inliers;
  for (uint32_t i = 0; i < 333; ++i) {
    const double angle = SymmetricEpipolarAngle(world.b_from_a, pairs.A(i), pairs.B(i));
    cost += std::pow(std::sin(std::min(angle, kMaxErrorRad)), 2);
    if (angle < kMaxErrorRad) inliers.push_back(i);
  }
  EXPECT_NEAR(score->cost, cost, 1e-12 * 333);
  EXPECT_EQ(score->num_inliers, inliers.size());
  EXPECT_EQ(EpipolarInliers(pairs, world.b_from_a, kMaxErrorRad), inliers);
}

TEST(ScoreEpipolar, StopsAtTheGate) {
  const TwoViewWorld world = MakeTwoViewWorld(3, 300, 0.5);
  EarlyRejection gate(300);
  gate.Raise(0.0, 300);
  EXPECT_FALSE(ScoreEpipolar(Arrange(world), world.b_from_a, kMaxErrorRad, gate).has_value());
}

}  // namespace
}  // namespace orbweave
