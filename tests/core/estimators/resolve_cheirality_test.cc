// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/resolve_cheirality.h"

#include <gtest/gtest.h>

#include "core/geometry/essential.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using testing::MakeTwoViewWorld;
using testing::RotationError;
using testing::TwoViewWorld;

constexpr double kMaxErrorRad = 4.7e-3;

BearingPairs Arrange(const TwoViewWorld& world) {
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0; i < world.bearings_a.size(); ++i) matches.push_back({i, i});
  return ArrangePairs(world.bearings_a, world.bearings_b, matches, 1);
}

TEST(ResolveCheirality, FindsTheTruePoseFromAnyOfTheFour) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const TwoViewWorld world = MakeTwoViewWorld(seed, 100, 0.3, 1e-4);
    const BearingPairs pairs = Arrange(world);
    for (const Rigid3& start : PosesFromEssential(EssentialFromPose(world.b_from_a))) {
      const ResolvedPose resolved = ResolveCheirality(pairs, start, kMaxErrorRad);
      EXPECT_LT(RotationError(resolved.b_from_a.rotation, world.b_from_a.rotation), 1e-7);
      EXPECT_LT((resolved.b_from_a.translation - world.b_from_a.translation).norm(), 1e-7);
      EXPECT_GE(resolved.inliers.size(), 70U);
    }
  }
}

TEST(InFrontOfBoth, DropsPairsOnTheWrongSideButNotFarPoints) {
  TwoViewWorld world = MakeTwoViewWorld(1, 10);
  world.bearings_b[3] *= -1.0;                                          // wrong side
  world.bearings_b[5] = world.b_from_a.rotation * world.bearings_a[5];  // at infinity
  const BearingPairs pairs = Arrange(world);
  std::vector<uint32_t> all(10);
  for (uint32_t i = 0; i < 10; ++i) all[i] = i;
  std::vector<uint32_t> kept;
  for (const uint32_t i : InFrontOfBoth(pairs, all, world.b_from_a, kMaxErrorRad))
    kept.push_back(pairs.order[i]);
  std::sort(kept.begin(), kept.end());
  EXPECT_EQ(kept, (std::vector<uint32_t>{0, 1, 2, 4, 5, 6, 7, 8, 9}));
}

TEST(ResolveCheirality, KeepsThePoseWithoutInliers) {
  const TwoViewWorld world = MakeTwoViewWorld(1, 0);
  const ResolvedPose resolved = ResolveCheirality(Arrange(world), world.b_from_a, kMaxErrorRad);
  EXPECT_TRUE(resolved.inliers.empty());
  EXPECT_EQ(resolved.b_from_a.translation, world.b_from_a.translation);
}

}  // namespace
}  // namespace orbweave
