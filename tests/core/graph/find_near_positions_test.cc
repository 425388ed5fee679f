// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/find_near_positions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"

namespace orbweave {
namespace {

TEST(FindNearPositions, AgreesWithLookingAtEveryPair) {
  Random random(3);
  std::vector<Eigen::Vector2d> positions;
  for (int i = 0; i < 200; ++i) {
    positions.emplace_back(random.Uniform(-50.0, 50.0), random.Uniform(-50.0, 50.0));
  }
  const auto near = FindNearPositions(positions, 12.0, 5);
  for (uint32_t i = 0; i < positions.size(); ++i) {
    std::vector<std::pair<double, uint32_t>> expected;
    for (uint32_t j = 0; j < positions.size(); ++j) {
      const double distance = (positions[i] - positions[j]).norm();
      if (j != i && distance <= 12.0) expected.emplace_back(distance, j);
    }
    std::sort(expected.begin(), expected.end());
    if (expected.size() > 5) expected.resize(5);
    ASSERT_EQ(near[i].size(), expected.size());
    for (size_t n = 0; n < expected.size(); ++n) EXPECT_EQ(near[i][n], expected[n].second);
  }
}

TEST(FindNearPositions, LooksAcrossCellBordersAndTheOrigin) {
  const std::vector<Eigen::Vector2d> positions = {
      {-0.1, -0.1}, {0.1, 0.1}, {9.9, 0.0}, {10.1, 0.0}};
  const auto near = FindNearPositions(positions, 10.0, 10);
  EXPECT_EQ(near[0], (std::vector<uint32_t>{1}));
  EXPECT_EQ(near[1], (std::vector<uint32_t>{0, 2}));
  EXPECT_EQ(near[3], (std::vector<uint32_t>{2}));
}

TEST(FindNearPositions, FindsNothingInARadiusOfZero) {
  const std::vector<Eigen::Vector2d> positions(3, Eigen::Vector2d::Zero());
  for (const auto& near : FindNearPositions(positions, 0.0, 5)) EXPECT_TRUE(near.empty());
}

}  // namespace
}  // namespace orbweave
