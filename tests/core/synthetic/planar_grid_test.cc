// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/planar_grid.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace orbweave {
namespace {

TEST(PlanarGrid, FindsWhatLookingAtAllPointsFinds) {
  Random random(7);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 500; ++i)
    points.emplace_back(random.Uniform(-90, 90), random.Uniform(-90, 90));
  const PlanarGrid grid(points, 10.0);
  for (const double radius_m : {0.0, 4.0, 25.0}) {
    for (int k = 0; k < 50; ++k) {
      const Eigen::Vector2d centre(random.Uniform(-100, 100), random.Uniform(-100, 100));
      std::vector<uint32_t> expected;
      for (uint32_t i = 0; i < points.size(); ++i) {
        if ((points[i] - centre).norm() <= radius_m) expected.push_back(i);
      }
      EXPECT_EQ(grid.Within(centre, radius_m), expected);
    }
  }
}

TEST(PlanarGrid, IsEmptyWithoutPoints) {
  EXPECT_TRUE(PlanarGrid({}, 1.0).Within({0, 0}, 5.0).empty());
}

}  // namespace
}  // namespace orbweave
