// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/view_graph_weights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

TEST(EdgeWeights, AreInliersTimesSpreadAndNeverZero) {
  ViewGraph graph{.num_images = 3, .edges = {Edge(0, 1, 100), Edge(0, 2, 0)}};
  graph.edges[1].spread = 0.0;
  EXPECT_THAT(EdgeWeights(graph), ElementsAre(DoubleEq(50.0), DoubleEq(1.0 / 64.0)));
}

TEST(ImageCosts, AreSharesOfAllMatches) {
  const ViewGraph graph{.num_images = 4, .edges = {Edge(0, 1, 100), Edge(1, 2, 200)}};
  EXPECT_THAT(ImageCosts(graph),
              ElementsAre(DoubleEq(0.5), DoubleEq(1.5), DoubleEq(1.0), DoubleEq(0.0)));
}

TEST(ImageCosts, StayWithinAQuarterAndFourTimesTheMean) {
  ViewGraph star{.num_images = 50};
  for (uint32_t leaf = 1; leaf < 50; ++leaf) star.edges.push_back(Edge(0, leaf));
  star.edges.back().num_inliers = 1;
  const std::vector<double> costs = ImageCosts(star);
  EXPECT_DOUBLE_EQ(costs.front(), 4.0);
  EXPECT_DOUBLE_EQ(costs.back(), 0.25);
}

TEST(ImageCosts, OfNoEdgesAreZero) {
  EXPECT_THAT(ImageCosts({.num_images = 2}), ElementsAre(0.0, 0.0));
}

}  // namespace
}  // namespace orbweave
