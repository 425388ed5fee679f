// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/crossing_pairs.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

ViewEdge LeadingEdge(uint32_t a, uint32_t b, TwoViewKind kind = TwoViewKind::kGeneral) {
  return {.pair = {ImageId(a), ImageId(b)},
          .kind = kind,
          .b_from_a = {.translation = Eigen::Vector3d(0.1 * a, 0.1 * b, 0.5)}};
}

TEST(CrossingPairs, AreThoseOfWhichNoClusterHasBothImages) {
  const ViewGraph graph{.num_images = 6,
                        .edges = {LeadingEdge(0, 1),
                                  LeadingEdge(0, 4),
                                  LeadingEdge(1, 2),
                                  LeadingEdge(1, 4, TwoViewKind::kPureRotation),
                                  LeadingEdge(1, 5),
                                  LeadingEdge(2, 4)}};
  const Partition partition{
      .clusters = {{.images = {ImageId(0), ImageId(1), ImageId(2)}},
                   {.images = {ImageId(2), ImageId(3), ImageId(4), ImageId(5)}}}};
  const std::vector<CrossingPair> crossing = CrossingPairs(graph, partition);
  ASSERT_EQ(crossing.size(), 2U);
  EXPECT_EQ(crossing[0].pair, (ImagePair{ImageId(0), ImageId(4)}));
  EXPECT_EQ(crossing[1].pair, (ImagePair{ImageId(1), ImageId(5)}));
  EXPECT_EQ(crossing[1].b_from_a.translation, graph.edges[4].b_from_a.translation);
}

TEST(CrossingPairs, AreNoneOfAnUndividedGraph) {
  const ViewGraph graph{.num_images = 2, .edges = {LeadingEdge(0, 1)}};
  EXPECT_TRUE(CrossingPairs(graph, {.clusters = {{.images = {ImageId(0), ImageId(1)}}}}).empty());
}

}  // namespace
}  // namespace orbweave
