// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/build_view_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "core/graph/disjoint_sets.h"
#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

Eigen::Vector3d RandomVector(Random& random) {
  return {random.Normal(), random.Normal(), random.Normal()};
}

// Gives the edges of a graph the relative rotations of random cameras, with noise.
ViewGraph WithRotations(ViewGraph graph, double noise_rad) {
  Random random(11);
  std::vector<Eigen::Quaterniond> cam_from_world;
  for (uint32_t i = 0; i < graph.num_images; ++i) {
    cam_from_world.push_back(RotationFromVector(RandomVector(random)));
  }
  for (ViewEdge& edge : graph.edges) {
    edge.b_from_a.rotation = RotationFromVector(noise_rad * RandomVector(random)) *
                             cam_from_world[edge.pair.b.value] *
                             cam_from_world[edge.pair.a.value].conjugate();
  }
  return graph;
}

void Spoil(ViewGraph& graph, uint32_t a, uint32_t b) {
  for (ViewEdge& edge : graph.edges) {
    if (edge.pair == MakePair(ImageId(a), ImageId(b))) {
      edge.b_from_a.rotation = RotationFromVector({0.0, 1.0, 0.0}) * edge.b_from_a.rotation;
    }
  }
}

TEST(BuildViewGraph, KeepsEveryEdgeThatCloses) {
  const ViewGraph street = WithRotations(Street(30, 5), 0.002);
  const FilteredViewGraph filtered = BuildViewGraph(30, street.edges, {});
  EXPECT_EQ(filtered.graph.num_images, 30U);
  EXPECT_EQ(filtered.graph.edges.size(), street.edges.size());
  EXPECT_TRUE(filtered.dropped.empty());
}

TEST(BuildViewGraph, DropsExactlyTheWrongEdges) {
  ViewGraph street = WithRotations(Street(40, 6), 0.002);
  const std::set<ImagePair> wrong = {{ImageId(10), ImageId(12)},
                                     {ImageId(11), ImageId(12)},
                                     {ImageId(12), ImageId(16)},
                                     {ImageId(30), ImageId(31)}};
  for (const ImagePair& pair : wrong) Spoil(street, pair.a.value, pair.b.value);
  const FilteredViewGraph filtered = BuildViewGraph(40, street.edges, {});
  EXPECT_EQ(PairsOf(filtered.dropped), wrong);
  EXPECT_EQ(filtered.graph.edges.size() + wrong.size(), street.edges.size());
  EXPECT_NE(filtered.dropped.front().reason.find("triplets do not close"), std::string::npos);
}

TEST(BuildViewGraph, DropsTheWeakestSideOfALonelyTriangle) {
  ViewGraph triangle = WithRotations(Street(3, 2), 0.0);  // (0,2) is the weakest
  Spoil(triangle, 0, 1);
  const FilteredViewGraph filtered = BuildViewGraph(3, triangle.edges, {});
  ASSERT_EQ(filtered.dropped.size(), 1U);
  EXPECT_EQ(filtered.dropped[0].pair, (ImagePair{ImageId(0), ImageId(2)}));
  EXPECT_EQ(filtered.dropped[0].reason, "1 of 1 triplets do not close");
}

TEST(BuildViewGraph, BlamesTheWeakEdgesRoundAStrongOneThatIsInAllTheirTriangles) {
  // Images 0 ... 5 in a row; 2-3 is seen well, and everything that reaches across it is wrong.
  ViewGraph row{.num_images = 6};
  for (const auto& [a, b, inliers] : std::vector<std::array<uint32_t, 3>>{{0, 1, 200},
                                                                          {0, 2, 100},
                                                                          {1, 2, 200},
                                                                          {1, 3, 29},
                                                                          {2, 3, 276},
                                                                          {2, 4, 175},
                                                                          {2, 5, 24},
                                                                          {3, 4, 341},
                                                                          {3, 5, 220},
                                                                          {4, 5, 418}}) {
    row.edges.push_back({.pair = MakePair(ImageId(a), ImageId(b)), .num_inliers = inliers});
  }
  row = WithRotations(row, 0.002);
  Spoil(row, 1, 3);
  Spoil(row, 2, 4);
  Spoil(row, 2, 5);
  for (ViewEdge& edge : row.edges) {  // each wrong in its own way
    if (edge.pair == MakePair(ImageId(2), ImageId(4)))
      edge.b_from_a.rotation = RotationFromVector({0.5, 0.0, 0.2}) * edge.b_from_a.rotation;
  }
  const std::set<ImagePair> wrong = {MakePair(ImageId(1), ImageId(3)),
                                     MakePair(ImageId(2), ImageId(4)),
                                     MakePair(ImageId(2), ImageId(5))};
  EXPECT_EQ(PairsOf(BuildViewGraph(6, row.edges, {}).dropped), wrong);
}

ViewEdge EdgeOf(uint32_t a, uint32_t b, uint32_t num_inliers, double spread) {
  ViewEdge edge = Edge(a, b, num_inliers);
  edge.spread = spread;
  return edge;
}

TEST(BuildViewGraph, BelievesOneStrongPairMoreThanTwoWeakOnesThatAgree) {
  // A town: 0, 1, 2 and 3 one after the other; a taxi beside the camera in 0, 1 and 3.
  ViewGraph row{.num_images = 4,
                .edges = {EdgeOf(0, 1, 749, 0.77),
                          EdgeOf(0, 2, 257, 0.5),
                          EdgeOf(0, 3, 60, 0.38),
                          EdgeOf(1, 2, 454, 0.67),
                          EdgeOf(1, 3, 79, 0.31),
                          EdgeOf(2, 3, 221, 0.53)}};
  row = WithRotations(row, 0.002);
  const Eigen::Quaterniond by_the_taxi = RotationFromVector({0.0, 0.28, 0.0});
  for (ViewEdge& edge : row.edges) {
    if (edge.pair.b == ImageId(3) && edge.pair.a != ImageId(2))
      edge.b_from_a.rotation = by_the_taxi * edge.b_from_a.rotation;
  }
  const std::set<ImagePair> wrong = {MakePair(ImageId(0), ImageId(3)),
                                     MakePair(ImageId(1), ImageId(3))};
  EXPECT_EQ(PairsOf(BuildViewGraph(4, row.edges, {}).dropped), wrong);
}

TEST(BuildViewGraph, BelievesTwoPairsThatAgreeMoreThanOneWithAsManyInliersAsBoth) {
  ViewGraph row{.num_images = 4,
                .edges = {EdgeOf(0, 1, 457, 0.64),
                          EdgeOf(0, 2, 431, 0.62),
                          EdgeOf(0, 3, 153, 0.52),
                          EdgeOf(1, 2, 891, 0.73),
                          EdgeOf(1, 3, 346, 0.66),
                          EdgeOf(2, 3, 509, 0.59)}};
  row = WithRotations(row, 0.002);
  Spoil(row, 2, 3);
  EXPECT_EQ(PairsOf(BuildViewGraph(4, row.edges, {}).dropped),
            (std::set<ImagePair>{MakePair(ImageId(2), ImageId(3))}));
}

TEST(BuildViewGraph, KeepsEdgesInNoTriangle) {
  ViewGraph chain = WithRotations(Street(5, 1), 0.0);
  Spoil(chain, 2, 3);
  EXPECT_EQ(BuildViewGraph(5, chain.edges, {}).graph.edges.size(), 4U);
}

TEST(BuildViewGraph, NeverDisconnectsWhatWasConnected) {
  Random random(2);
  ViewGraph street = WithRotations(Street(30, 4), 0.0);
  for (ViewEdge& edge : street.edges) {
    if (random.Uniform() < 0.7) edge.b_from_a.rotation = RotationFromVector(RandomVector(random));
  }
  const FilteredViewGraph filtered = BuildViewGraph(30, street.edges, {});
  EXPECT_GT(filtered.dropped.size(), 10U);
  DisjointSets sets(30);
  for (const ViewEdge& edge : filtered.graph.edges)
    sets.Unite(edge.pair.a.value, edge.pair.b.value);
  EXPECT_EQ(sets.SizeOf(0), 30U);
}

TEST(BuildViewGraph, DropsPairsWithoutGeometryAndRepetitions) {
  std::vector<ViewEdge> edges = {Edge(1, 2, 50), Edge(0, 1), Edge(1, 2, 80)};
  edges[1].kind = TwoViewKind::kNone;
  const FilteredViewGraph filtered = BuildViewGraph(3, edges, {});
  ASSERT_EQ(filtered.graph.edges.size(), 1U);
  EXPECT_EQ(filtered.graph.edges[0].num_inliers, 80U);
  EXPECT_EQ(filtered.dropped.size(), 2U);
}

TEST(BuildViewGraph, DoesNotDependOnTheOrderOfTheEdges) {
  ViewGraph street = WithRotations(Street(20, 4), 0.0);
  for (uint32_t a = 0; a < 15; a += 3) Spoil(street, a, a + 2);
  const FilteredViewGraph forward = BuildViewGraph(20, street.edges, {});
  std::reverse(street.edges.begin(), street.edges.end());
  const FilteredViewGraph backward = BuildViewGraph(20, street.edges, {});
  EXPECT_EQ(PairsOf(forward.dropped), PairsOf(backward.dropped));
  EXPECT_TRUE(std::is_sorted(backward.graph.edges.begin(),
                             backward.graph.edges.end(),
                             [](const auto& x, const auto& y) { return x.pair < y.pair; }));
}

}  // namespace
}  // namespace orbweave
