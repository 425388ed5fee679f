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
        const bool meets = i != j && Distance(plan, i, j) <= found[i].reach_m + found[j].reach_m;
        EXPECT_EQ(is_neighbour, meets) << i << " " << j;
      }
    }
  }
}

TEST(MutualNeighbours, ReachOneAndAHalfTimesTheFarthestSource) {
  DensePlan plan = Scattered(3, 0.0, 1);
  for (size_t i = 0; i < 3; ++i) {
    plan.panoramas[i].unit_m = 2.0;
    plan.panoramas[i].cam_from_model =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {2.0 * static_cast<double>(i), 0, 0});
  }
  plan.panoramas[0].sources = {ImageId(3), ImageId(6), ImageId(77)};
  const std::vector<Neighbourhood> found = MutualNeighbours(plan, 24);
  EXPECT_DOUBLE_EQ(found[0].reach_m, 6.0);
  EXPECT_DOUBLE_EQ(found[1].reach_m, 3.0);
}

TEST(MutualNeighbours, OfNobodyAreNone) { EXPECT_TRUE(MutualNeighbours({}, 24).empty()); }

}  // namespace
}  // namespace orbweave
