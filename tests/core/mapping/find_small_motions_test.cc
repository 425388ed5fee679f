// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/find_small_motions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/mapping/slow_street.h"

namespace orbweave {
namespace {

constexpr double kTenDegrees_rad = 0.17;

size_t CountGeneral(const ClusterProblem& problem) {
  return static_cast<size_t>(
      std::ranges::count(problem.pairs, TwoViewKind::kGeneral, &TwoViewGeometry::kind));
}

TEST(FindSmallMotions, TellsWhereACameraWentThatHardlyMoved) {
  for (const bool is_turned : {false, true}) {
    const RayStreet world = MakeSlowStreet(10, 0.002, is_turned);
    ASSERT_EQ(CountGeneral(world.problem), 0U);
    const auto told = FindSmallMotions(world.problem);
    ASSERT_TRUE(told.has_value());
    const size_t num_told = CountGeneral(*told);
    EXPECT_GE(num_told, 5U);
    size_t exact = 0;
    for (const TwoViewGeometry& pair : told->pairs) {
      if (pair.kind != TwoViewKind::kGeneral) continue;
      const Rigid3 truth = world.cams_from_world[pair.pair.b.value] *
                           world.cams_from_world[pair.pair.a.value].Inverse();
      EXPECT_NEAR(pair.b_from_a.translation.norm(), 1.0, 1e-9);
      const double off_rad = AngleBetween(pair.b_from_a.translation, truth.translation);
      EXPECT_LT(off_rad, 3.0 * kTenDegrees_rad);
      exact += off_rad < kTenDegrees_rad ? 1 : 0;
      EXPECT_LT(RotationAngle(pair.b_from_a.rotation.conjugate() * truth.rotation), 1e-3);
    }
    EXPECT_GT(10 * exact, 8 * num_told);
  }
}

TEST(FindSmallMotions, TellsNothingOfACameraThatStands) {
  const RayStreet world = MakeSlowStreet(8, 0.0);
  ASSERT_EQ(CountGeneral(world.problem), 0U);
  EXPECT_FALSE(FindSmallMotions(world.problem).has_value());
}

TEST(FindSmallMotions, CloudsThatDriftBackwardsHideNoMotion) {
  constexpr double kDrift_rad = 0.002;  // from one panorama to the next
  RayStreet world = MakeSlowStreet(10, 0.002);
  for (uint32_t i = 0; i < world.problem.images.size(); ++i) {
    std::vector<Eigen::Vector3d>& bearings = world.problem.images[i].bearings;
    for (size_t feature = 0; feature < bearings.size(); ++feature) {
      const bool is_cloud = world.point_of_feature[i][feature] % 4 == 0;
      if (is_cloud && bearings[feature].y() < -0.3)
        bearings[feature] = RotationFromVector({0.0, kDrift_rad * i, 0.0}) * bearings[feature];
    }
  }
  const auto told = FindSmallMotions(world.problem);
  ASSERT_TRUE(told.has_value());
  EXPECT_GE(CountGeneral(*told), 5U);
}

TEST(FindSmallMotions, LeavesPairsAsTheyAreThatShowMore) {
  RayStreet world = MakeSlowStreet(12, 0.002);
  TwoViewGeometry& general = world.problem.pairs.back();
  general.kind = TwoViewKind::kGeneral;
  const auto told = FindSmallMotions(world.problem);
  ASSERT_TRUE(told.has_value());
  EXPECT_EQ(told->pairs.back().b_from_a.translation, general.b_from_a.translation);
  EXPECT_GT(CountGeneral(*told), 1U);
  for (TwoViewGeometry& pair : world.problem.pairs) pair.kind = TwoViewKind::kGeneral;
  EXPECT_FALSE(FindSmallMotions(world.problem).has_value());
}

TEST(FindSmallMotions, TellsNothingOfFewMatches) {
  RayStreet world = MakeSlowStreet(12, 0.002);
  for (TwoViewGeometry& pair : world.problem.pairs) pair.inliers.resize(50);
  EXPECT_FALSE(FindSmallMotions(world.problem).has_value());
}

}  // namespace
}  // namespace orbweave
