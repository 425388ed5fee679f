// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/divide_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

using Parts = std::vector<std::vector<uint32_t>>;

Parts Divide(const ViewGraph& graph,
             uint32_t num_parts,
             uint32_t min_part_size,
             std::vector<double> costs = {}) {
  if (costs.empty()) costs.assign(graph.num_images, 1.0);
  const Adjacency adjacency(graph.num_images, graph.edges);
  std::vector<double> weights;
  for (const ViewEdge& edge : graph.edges) weights.push_back(edge.num_inliers);
  std::vector<uint32_t> images(graph.num_images);
  std::iota(images.begin(), images.end(), 0U);
  const StrongLinks strong(adjacency, weights);
  const ConnectedPiece piece{.adjacency = adjacency,
                             .strong = strong,
                             .edge_weight = weights,
                             .image_cost = costs,
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
  std::vector<double> costs(90, 0.5);
  std::fill(costs.begin(), costs.begin() + 30, 2.0);
  const Parts parts = Divide(Street(90, 4), 3, 4, costs);
  ASSERT_EQ(parts.size(), 3U);
  for (const auto& part : parts) {
    double cost = 0.0;
    for (const uint32_t image : part) cost += costs[image];
    EXPECT_NEAR(cost, 30.0, 4.0);
  }
  EXPECT_LT(parts[0].size(), 20U);
}

/// A drive whose camera stands still for 15 images from `begin`: they see the same, and have most
/// in common.
ViewGraph StreetWithStop(uint32_t num_images, uint32_t begin) {
  constexpr uint32_t kStop = 15;
  const auto place = [&](uint32_t image) {
    return image < begin ? image : image < begin + kStop ? begin : image - kStop + 1;
  };
  ViewGraph graph{.num_images = num_images};
  for (uint32_t a = 0; a < num_images; ++a) {
    for (uint32_t b = a + 1; b <= a + 8 && b < num_images; ++b) {
      const double share = std::pow(0.6, place(b) - place(a));
      graph.edges.push_back(Edge(a, b, static_cast<uint32_t>(1000.0 * share)));
    }
  }
  return graph;
}

TEST(DivideGraph, MakesNoPartsThatHangTogetherByTheirWeakestLinks) {
  for (uint32_t begin = 40; begin < 100; ++begin) {
    const ViewGraph street = StreetWithStop(150, begin);
    const Parts parts = Divide(street, 4, 8);
    EXPECT_GE(parts.size(), 3U);
    EXPECT_LE(parts.size(), 6U);
    for (const auto& part : parts) {
      for (size_t i = 1; i < part.size(); ++i) {
        const bool stands = part[i] > begin && part[i] < begin + 15;
        EXPECT_LE(part[i] - part[i - 1], stands ? 15U : 5U) << "stop at " << begin;
      }
    }
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
