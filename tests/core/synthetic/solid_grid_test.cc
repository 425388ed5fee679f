// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/solid_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"

namespace orbweave {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Solid> RandomSolids(Random& random) {
  std::vector<Solid> solids;
  for (int i = 0; i < 60; ++i) {
    const double yaw = random.Uniform(0.0, 6.28);
    solids.push_back(
        {.kind = i % 4 == 0 ? SolidKind::kCrown : SolidKind::kBuilding,
         .centre = {random.Uniform(-40, 40), random.Uniform(-25, 25), random.Uniform(-2, 5)},
         .half = {random.Uniform(0.1, 4), random.Uniform(0.1, 4), random.Uniform(0.1, 4)},
         .along = {std::cos(yaw), std::sin(yaw)}});
  }
  return solids;
}

LightRay RandomRay(Random& random) {
  LightRay ray{{random.Uniform(-60, 60), random.Uniform(-40, 40), random.Uniform(-3, 6)},
               {random.Normal(), random.Normal(), 0.3 * random.Normal()}};
  ray.direction.normalize();
  return ray;
}

GridHit NearestOfAll(const std::vector<Solid>& solids, const LightRay& ray) {
  GridHit nearest;
  for (uint32_t i = 0; i < solids.size(); ++i) {
    const SolidHit hit = Intersect(ray, solids[i]);
    if (hit.distance_m < nearest.hit.distance_m) nearest = {hit, i};
  }
  return nearest;
}

TEST(SolidGrid, FindsWhatLookingAtAllSolidsFinds) {
  Random random(5);
  const std::vector<Solid> solids = RandomSolids(random);
  const SolidGrid grid(solids);
  int hits = 0;
  for (int i = 0; i < 5000; ++i) {
    const LightRay ray = RandomRay(random);
    const GridHit expected = NearestOfAll(solids, ray);
    const GridHit found = grid.Nearest(ray, kInfinity);
    ASSERT_EQ(found.hit.distance_m, expected.hit.distance_m) << i;
    ASSERT_EQ(found.hit.face, expected.hit.face) << i;
    ASSERT_EQ(grid.IsHit(ray), expected.hit.face >= 0) << i;
    if (expected.hit.face >= 0) {
      ++hits;
      ASSERT_EQ(found.solid, expected.solid);
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(SolidGrid, SeesNothingBeyondTheLimit) {
  const SolidGrid grid({{.centre = {10.0, 0.0, 0.0}}});
  const LightRay ray{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()};
  EXPECT_EQ(grid.Nearest(ray, 8.9).hit.face, -1);
  EXPECT_DOUBLE_EQ(grid.Nearest(ray, 9.1).hit.distance_m, 9.0);
}

TEST(SolidGrid, FollowsRaysAlongAxesAndStraightUp) {
  const SolidGrid grid({{.centre = {0.0, 10.0, 0.0}}, {.centre = {0.0, 0.0, 10.0}}});
  EXPECT_EQ(grid.Nearest({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY()}, kInfinity).solid, 0U);
  EXPECT_EQ(grid.Nearest({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()}, kInfinity).solid, 1U);
  EXPECT_FALSE(grid.IsHit({Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitX()}));
}

TEST(SolidGrid, HoldsNothingWithoutSolids) {
  EXPECT_FALSE(SolidGrid().IsHit({}));
  EXPECT_FALSE(SolidGrid(std::vector<Solid>{}).IsHit({}));
}

}  // namespace
}  // namespace orbweave
