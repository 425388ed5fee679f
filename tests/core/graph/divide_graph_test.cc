// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/divide_graph.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

using Parts = std::vector<std::vector<uint32_t>>;

Parts Divide(const ViewGraph& graph, uint32_t num_parts, uint32_t min_part_size) {
  const Adjacency adjacency(graph.num_images, graph.edges);
  std::vector<double> weights;
  for (const ViewEdge& edge : graph.edges) weights.push_back(edge.num_inliers);
  std::vector<uint32_t> images(graph.num_images);
  std::iota(images.begin(), images.end(), 0U);
  const ConnectedPiece piece{.adjacency = adjacency, .edge_weight = weights, .images = images};
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
