// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/grow_overlap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<LentImages> Grow(const ViewGraph& graph,
                             const std::vector<uint32_t>& part_of,
                             size_t overlap) {
  const Adjacency adjacency(graph.num_images, graph.edges);
  std::vector<double> weights;
  for (const ViewEdge& edge : graph.edges) weights.push_back(edge.num_inliers);
  return GrowOverlap(adjacency, weights, part_of, {.usual = overlap});
}

std::vector<uint32_t> HalfAndHalf(uint32_t n) {
  std::vector<uint32_t> part_of(n, 0);
  for (uint32_t i = n / 2; i < n; ++i) part_of[i] = 1;
  return part_of;
}

TEST(GrowOverlap, TakesTheImagesNearestToTheSeamFromBothSides) {
  const auto shared = Grow(Street(20, 3), HalfAndHalf(20), 6);
  ASSERT_EQ(shared.size(), 1U);
  EXPECT_THAT(shared[0].lent_to_a, ElementsAre(10, 11, 12));
  EXPECT_THAT(shared[0].lent_to_b, ElementsAre(7, 8, 9));
}

TEST(GrowOverlap, FollowsAChainBeyondTheCutEdge) {
  const auto shared = Grow(Street(10, 1), HalfAndHalf(10), 6);
  ASSERT_EQ(shared.size(), 1U);
  EXPECT_THAT(shared[0].lent_to_a, ElementsAre(5, 6, 7));
  EXPECT_THAT(shared[0].lent_to_b, ElementsAre(2, 3, 4));
}

TEST(GrowOverlap, GoesOnWithOneSideWhenTheOtherHasNoMore) {
  std::vector<uint32_t> part_of(10, 1);
  part_of[0] = 0;
  const auto shared = Grow(Street(10, 1), part_of, 6);
  ASSERT_EQ(shared.size(), 1U);
  EXPECT_THAT(shared[0].lent_to_a, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(shared[0].lent_to_b, ElementsAre(0));
}

TEST(GrowOverlap, TakesThemWhereverPartsMeet) {
  const auto shared = Grow(Loop(40, 3), HalfAndHalf(40), 6);
  ASSERT_EQ(shared.size(), 1U);
  EXPECT_THAT(shared[0].lent_to_a, ElementsAre(20, 21, 22, 37, 38, 39));
  EXPECT_THAT(shared[0].lent_to_b, ElementsAre(0, 1, 2, 17, 18, 19));
}

TEST(GrowOverlap, LendsAnImageOnceThatTwoPlacesAskFor) {
  const auto shared = Grow(Loop(16, 1), HalfAndHalf(16), 12);
  ASSERT_EQ(shared.size(), 1U);
  EXPECT_THAT(shared[0].lent_to_a, ElementsAre(8, 9, 10, 11, 12, 13, 14, 15));
  EXPECT_THAT(shared[0].lent_to_b, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
}

TEST(GrowOverlap, StopsWhenEverythingIsShared) {
  const auto shared = Grow(Street(4, 1), HalfAndHalf(4), 12);
  ASSERT_EQ(shared.size(), 1U);
  EXPECT_EQ(shared[0].lent_to_a.size() + shared[0].lent_to_b.size(), 4U);
}

TEST(GrowOverlap, SharesNothingBetweenUnconnectedParts) {
  ViewGraph graph{.num_images = 4, .edges = {Edge(0, 1), Edge(2, 3)}};
  EXPECT_THAT(Grow(graph, HalfAndHalf(4), 4), IsEmpty());
}

}  // namespace
}  // namespace orbweave
