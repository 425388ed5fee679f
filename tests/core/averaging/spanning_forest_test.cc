// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/spanning_forest.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(WalkSpanningForest, TakesTheStrongestEdgesThatCloseNoRing) {
  const std::vector<GraphEdge> edges = {{0, 1}, {1, 2}, {2, 0}, {2, 3}};
  const std::vector<uint8_t> is_root = {0, 0, 1, 0};
  const auto steps = WalkSpanningForest(edges, Eigen::Vector4d(1.0, 5.0, 3.0, 0.1), is_root);
  ASSERT_EQ(steps.size(), 3U);
  for (const ForestStep& step : steps) {
    EXPECT_NE(step.edge, 0U);  // the weakest of the ring
    const GraphEdge& edge = edges[step.edge];
    EXPECT_TRUE((edge.a == step.from && edge.b == step.to) ||
                (edge.b == step.from && edge.a == step.to));
    EXPECT_EQ(step.from, 2U);
  }
}

TEST(WalkSpanningForest, ReachesANodeBeforeItGoesOnFromIt) {
  std::vector<GraphEdge> edges;
  for (uint32_t i = 0; i + 1 < 10; ++i) edges.push_back({i, i + 1});
  std::vector<uint8_t> is_reached(10, 0);
  is_reached[4] = 1;
  for (const ForestStep& step : WalkSpanningForest(edges, Eigen::VectorXd::Ones(9), is_reached)) {
    EXPECT_EQ(is_reached[step.from], 1);
    EXPECT_EQ(is_reached[step.to], 0);
    is_reached[step.to] = 1;
  }
  EXPECT_EQ(is_reached, std::vector<uint8_t>(10, 1));
}

TEST(WalkSpanningForest, LeavesPartsWithoutARootAlone) {
  const std::vector<uint8_t> is_root = {1, 0, 0, 0};
  const auto steps = WalkSpanningForest({{0, 1}, {2, 3}}, Eigen::Vector2d::Ones(), is_root);
  ASSERT_EQ(steps.size(), 1U);
  EXPECT_EQ(steps[0].to, 1U);
}

}  // namespace
}  // namespace orbweave
