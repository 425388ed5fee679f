// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/adjacency.h"

#include <gtest/gtest.h>

#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

TEST(Adjacency, ListsBothEndsOfEveryEdgeSorted) {
  const std::vector<ViewEdge> edges = {Edge(1, 3), Edge(0, 3), Edge(0, 1)};
  const Adjacency adjacency(5, edges);
  ASSERT_EQ(adjacency.Of(3).size(), 2U);
  EXPECT_EQ(adjacency.Of(3)[0].image, 0U);
  EXPECT_EQ(adjacency.Of(3)[0].edge, 1U);
  EXPECT_EQ(adjacency.Of(3)[1].image, 1U);
  EXPECT_TRUE(adjacency.Of(2).empty());
  EXPECT_TRUE(adjacency.Of(4).empty());
}

TEST(Adjacency, FindsTheThirdCornersOfAnEdge) {
  const ViewGraph street = Street(6, 3);
  const Adjacency adjacency(street.num_images, street.edges);
  std::vector<uint32_t> corners;
  ForEachCommonLink(adjacency.Of(2), adjacency.Of(3), [&](uint32_t c, uint32_t ca, uint32_t cb) {
    corners.push_back(c);
    EXPECT_EQ(street.edges[ca].pair, MakePair(ImageId(2), ImageId(c)));
    EXPECT_EQ(street.edges[cb].pair, MakePair(ImageId(3), ImageId(c)));
  });
  EXPECT_EQ(corners, (std::vector<uint32_t>{0, 1, 4, 5}));
}

}  // namespace
}  // namespace orbweave
