// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/meeting_places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

using Pairs = std::vector<std::pair<uint32_t, uint32_t>>;

std::vector<uint32_t> Halves(uint32_t n) {
  std::vector<uint32_t> part_of(n, 0);
  for (uint32_t i = n / 2; i < n; ++i) part_of[i] = 1;
  return part_of;
}

/// The cut edges of every place where parts 0 and 1 meet.
std::vector<Pairs> Places(const ViewGraph& graph, const std::vector<uint32_t>& part_of) {
  const Adjacency adjacency(graph.num_images, graph.edges);
  std::vector<double> weights;
  for (const ViewEdge& edge : graph.edges) weights.push_back(edge.num_inliers);
  const auto places = FindMeetingPlaces(adjacency, weights, part_of);
  std::vector<Pairs> pairs;
  if (places.empty()) return pairs;
  for (const MeetingPlace& place : places.at({0, 1})) {
    Pairs& edges = pairs.emplace_back();
    for (const CutEdge& cut : place) {
      edges.emplace_back(cut.in_a, cut.in_b);
      const ImagePair expected = MakePair(ImageId(cut.in_a), ImageId(cut.in_b));
      EXPECT_EQ(graph.edges[cut.edge].pair, expected);
    }
  }
  return pairs;
}

TEST(MeetingPlaces, OneWhereAStreetIsCut) {
  EXPECT_THAT(Places(Street(10, 1), Halves(10)), ElementsAre(Pairs{{4, 5}}));
  EXPECT_THAT(Places(Street(10, 2), Halves(10)), ElementsAre(Pairs{{3, 5}, {4, 5}, {4, 6}}));
}

TEST(MeetingPlaces, TwoWhereABlockIsCut) {
  const auto places = Places(Loop(20, 2), Halves(20));
  EXPECT_THAT(places,
              ElementsAre(Pairs{{0, 18}, {0, 19}, {1, 19}}, Pairs{{8, 10}, {9, 10}, {9, 11}}));
}

TEST(MeetingPlaces, OneOfDrivesSideBySide) {
  ViewGraph graph = Street(20, 1);
  const ViewGraph second = Street(20, 1);
  graph.num_images = 40;
  for (const ViewEdge& edge : second.edges)
    graph.edges.push_back(Edge(edge.pair.a.value + 20, edge.pair.b.value + 20, edge.num_inliers));
  for (uint32_t i = 0; i < 20; ++i) graph.edges.push_back(Edge(i, i + 20, 300));
  std::vector<uint32_t> part_of = Halves(40);
  EXPECT_THAT(Places(graph, part_of), ElementsAre(SizeIs(20))) << "one drive each";
  for (uint32_t i = 0; i < 40; ++i) part_of[i] = i % 20 < 10 ? 0 : 1;
  EXPECT_THAT(Places(graph, part_of), ElementsAre(Pairs{{9, 10}, {29, 30}})) << "half of both each";
}

TEST(MeetingPlaces, NoneWherePartsOnlyLookAlike) {
  ViewGraph street = Street(40, 2);
  street.edges.push_back(Edge(2, 37, 20));
  EXPECT_THAT(Places(street, Halves(40)), ElementsAre(SizeIs(3)));
  street.edges.push_back(Edge(19, 30, 20));
  EXPECT_THAT(Places(street, Halves(40)), ElementsAre(SizeIs(4)))
      << "at one end it is at the place";
}

TEST(MeetingPlaces, OneOfPartsThatWeakPairsAloneJoin) {
  ViewGraph graph{
      .num_images = 6,
      .edges = {Edge(0, 1), Edge(0, 3, 5), Edge(1, 2), Edge(2, 5, 4), Edge(3, 4), Edge(4, 5)}};
  EXPECT_THAT(Places(graph, Halves(6)), ElementsAre(Pairs{{0, 3}, {2, 5}}));
}

TEST(MeetingPlaces, NoneOfPartsThatNothingJoins) {
  const ViewGraph graph{.num_images = 4, .edges = {Edge(0, 1), Edge(2, 3)}};
  EXPECT_THAT(Places(graph, Halves(4)), IsEmpty());
}

}  // namespace
}  // namespace orbweave
