// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/divide_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

using Parts = std::vector<std::vector<uint32_t>>;

struct Demands {
  std::vector<double> costs{};     // empty: all alike
  std::vector<uint32_t> groups{};  // empty: each image alone
};

Parts Divide(const ViewGraph& graph,
             uint32_t num_parts,
             uint32_t min_part_size,
             Demands demands = {}) {
  const Adjacency adjacency(graph.num_images, graph.edges);
  std::vector<double> weights;
  for (const ViewEdge& edge : graph.edges) weights.push_back(edge.num_inliers);
  std::vector<uint32_t> images(graph.num_images);
  std::iota(images.begin(), images.end(), 0U);
  if (demands.costs.empty()) demands.costs.assign(graph.num_images, 1.0);
  if (demands.groups.empty()) demands.groups = images;
  const ConnectedPiece piece{.adjacency = adjacency,
                             .edge_weight = weights,
                             .image_cost = demands.costs,
                             .group_of = demands.groups,
                             .images = images};
  const auto parts = DivideGraph(piece, num_parts, min_part_size);
  EXPECT_TRUE(parts.ok()) << parts.status();
  return parts.ok() ? *parts : Parts{};
}

TEST(DivideGraph, CutsAStreetIntoConsecutivePieces) {
  const Parts parts = Divide(Street(100, 5), 4, 8);
  ASSERT_EQ(parts.size(), 4U);
  uint32_t next = 0;
  for (const auto& part : parts) {
    EXPECT_GE(part.size(), 20U);
    EXPECT_LE(part.size(), 30U);
    for (const uint32_t image : part) EXPECT_EQ(image, next++);
  }
}

TEST(DivideGraph, CutsWhereTheWeightIsSmall) {
  ViewGraph street = Street(40, 1);
  for (ViewEdge& edge : street.edges) edge.num_inliers = edge.pair.a.value == 17 ? 1 : 100;
  const Parts parts = Divide(street, 2, 4);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_GE(parts[0].size(), 18U);
  EXPECT_LE(parts[0].size(), 22U);
}

TEST(DivideGraph, BalancesCosts) {
  Demands demands{.costs = std::vector<double>(90, 0.5)};
  std::fill(demands.costs.begin(), demands.costs.begin() + 30, 2.0);
  const Parts parts = Divide(Street(90, 4), 3, 4, demands);
  ASSERT_EQ(parts.size(), 3U);
  for (const auto& part : parts) {
    double cost = 0.0;
    for (const uint32_t image : part) cost += demands.costs[image];
    EXPECT_NEAR(cost, 30.0, 4.0);
  }
  EXPECT_LT(parts[0].size(), 20U);
}

TEST(DivideGraph, LeavesGroupsWhole) {
  Demands demands{.groups = std::vector<uint32_t>(60)};
  std::iota(demands.groups.begin(), demands.groups.end(), 0U);
  // Half a street wide, where two equal parts would meet.
  std::fill(demands.groups.begin() + 20, demands.groups.begin() + 40, 20U);
  const Parts parts = Divide(Street(60, 4), 2, 4, demands);
  ASSERT_EQ(parts.size(), 2U);
  for (const auto& part : parts) {
    EXPECT_EQ(std::ranges::count(part, 20U), std::ranges::count(part, 39U));
  }
}

TEST(DivideGraph, LeavesNoTinyPartsOfAStar) {
  ViewGraph star{.num_images = 50};
  for (uint32_t leaf = 1; leaf < 50; ++leaf) star.edges.push_back(Edge(0, leaf));
  const Parts parts = Divide(star, 3, 8);
  ASSERT_EQ(parts.size(), 1U) << "the leaves of a star hang together through its hub alone";
  EXPECT_EQ(parts[0].size(), 50U);
}

TEST(DivideGraph, TakesWeightsOfAnySize) {
  ViewGraph street = Street(60, 4);
  for (ViewEdge& edge : street.edges) edge.num_inliers *= 5'000'000U;
  EXPECT_EQ(Divide(street, 3, 4).size(), 3U);
}

}  // namespace
}  // namespace orbweave
