// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/list_fusions/mutual_neighbours.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace orbweave {
namespace {

DensePlan Scattered(size_t count, double extent_m, uint64_t seed) {
  Random random(seed);
  DensePlan plan;
  for (uint32_t i = 0; i < count; ++i) {
    const Eigen::Vector3d centre(
        random.Uniform(0.0, extent_m), random.Uniform(0.0, extent_m), random.Uniform(0.0, 1.0));
    plan.panoramas.push_back(
        {.file = {.image = ImageId(3 * i)},
         .cam_from_model = Rigid3::FromCentre(Eigen::Quaterniond::Identity(), centre),
         .unit_m = random.Uniform(1.0, 8.0)});
  }
  return plan;
}

double Distance(const DensePlan& plan, size_t i, size_t j) {
  return (plan.panoramas[i].cam_from_model.Centre() - plan.panoramas[j].cam_from_model.Centre())
      .norm();
}

TEST(MutualNeighbours, AreAllWhoseReachesMeetAndNoOthers) {
  for (const size_t most : {4, 24}) {
    const DensePlan plan = Scattered(120, 60.0, 5);
    const std::vector<Neighbourhood> found = MutualNeighbours(plan, most);
    ASSERT_EQ(found.size(), plan.panoramas.size());
    for (size_t i = 0; i < found.size(); ++i) {
      for (size_t j = 0; j < found.size(); ++j) {
        const bool is_neighbour =
            std::ranges::count(found[i].neighbours, plan.panoramas[j].file.image) > 0;
        const bool meets = i != j && found[j].gives_points &&
                           Distance(plan, i, j) <= found[i].reach_m + found[j].reach_m;
        EXPECT_EQ(is_neighbour, meets) << i << " " << j;
      }
    }
  }
}

DensePlan Row(size_t count, double spacing_m, double unit_m) {
  DensePlan plan = Scattered(count, 0.0, 1);
  for (size_t i = 0; i < count; ++i) {
    plan.panoramas[i].unit_m = unit_m;
    plan.panoramas[i].cam_from_model = Rigid3::FromCentre(
        Eigen::Quaterniond::Identity(), {spacing_m * static_cast<double>(i), 0.0, 0.0});
  }
  return plan;
}

TEST(MutualNeighbours, AllOfAStreetGivePointsAndReachToThreeHousesOnBothSides) {
  const std::vector<Neighbourhood> found = MutualNeighbours(Row(60, 2.5, 2.5), 26);
  for (const Neighbourhood& of_one : found) {
    EXPECT_TRUE(of_one.gives_points);
    EXPECT_DOUBLE_EQ(of_one.reach_m, 15.0);
  }
  EXPECT_EQ(found[30].neighbours.size(), 24U);
}

TEST(MutualNeighbours, SomeFramesOfAVideoGivePointsAndReachAsFar) {
  const std::vector<Neighbourhood> found = MutualNeighbours(Row(400, 0.1, 1.2), 26);
  size_t givers = 0;
  for (size_t i = 0; i < found.size(); ++i) {
    givers += found[i].gives_points ? 1 : 0;
    EXPECT_DOUBLE_EQ(found[i].reach_m, 7.2) << i;
    EXPECT_LE(found[i].neighbours.size(), 26U) << i;
  }
  EXPECT_GT(givers, 30U);
  EXPECT_LT(givers, 45U);
}

TEST(MutualNeighbours, OfNobodyAreNone) { EXPECT_TRUE(MutualNeighbours({}, 24).empty()); }

}  // namespace
}  // namespace orbweave
