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

TEST(ImageCosts, GoHalfByTheBestPairAndAreOneOnAverage) {
  const ViewGraph graph{.num_images = 5,
                        .edges = {Edge(0, 1, 300), Edge(1, 2, 100), Edge(2, 3, 100)}};
  // Best pairs: 300, 300, 100, 100, none; the mean of four is 200.
  EXPECT_THAT(ImageCosts(graph), ElementsAre(1.25, 1.25, 0.75, 0.75, 0.5));
  EXPECT_THAT(ImageCosts({.num_images = 2}), ElementsAre(0.5, 0.5));
}

TEST(ImageCosts, DoNotGrowWithTheNumberOfPairs) {
  const ViewGraph few = Street(50, 2);
  const ViewGraph many = Street(50, 10);
  EXPECT_EQ(ImageCosts(few), ImageCosts(many));
}

}  // namespace
}  // namespace orbweave
