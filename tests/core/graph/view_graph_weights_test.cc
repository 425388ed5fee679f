// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/view_graph_weights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

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

TEST(ImageCosts, AreMatchesPerMedianWithinBounds) {
  const ViewGraph graph{
      .num_images = 6,
      .edges = {Edge(0, 1, 1000), Edge(1, 2, 100), Edge(2, 3, 100), Edge(3, 4, 10)}};
  // Matches: 1000, 1100, 200, 110, 10, none; the median of five is 200.
  EXPECT_THAT(ImageCosts(graph),
              ElementsAre(DoubleEq(2.0),
                          DoubleEq(2.0),
                          DoubleEq(1.0),
                          DoubleEq(0.55),
                          DoubleEq(0.5),
                          DoubleEq(1.0)));
  EXPECT_THAT(ImageCosts({.num_images = 2}), ElementsAre(1.0, 1.0));
}

ViewGraph Stop(uint32_t num_images) {
  ViewGraph graph = Street(num_images, 3);
  for (ViewEdge& edge : graph.edges) edge.kind = TwoViewKind::kPureRotation;
  return graph;
}

TEST(StandingGroups, JoinImagesOfOneCentre) {
  ViewGraph graph = Street(12, 3);
  for (ViewEdge& edge : graph.edges) {
    if (edge.pair.a >= ImageId(4) && edge.pair.b < ImageId(8)) {
      edge.kind = TwoViewKind::kPureRotation;
    }
  }
  EXPECT_THAT(StandingGroups(graph, std::vector<uint32_t>(12, 6)),
              ElementsAre(0, 1, 2, 3, 4, 4, 4, 4, 8, 9, 10, 11));
}

TEST(StandingGroups, AreNoLargerThanAllowed) {
  std::map<uint32_t, uint32_t> sizes;
  for (const uint32_t first : StandingGroups(Stop(100), std::vector<uint32_t>(100, 15))) {
    ++sizes[first];
  }
  for (const auto& [first, size] : sizes) EXPECT_LE(size, 15U) << first;
  EXPECT_LT(sizes.size(), 20U);
}

}  // namespace
}  // namespace orbweave
