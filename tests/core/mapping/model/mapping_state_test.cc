// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/mapping_state.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

/// What VisibilityPyramid must hold, counted afresh.
uint32_t CountVisible(const MappingState& state, ImageSlot image) {
  uint32_t count = 0;
  const CorrespondenceGraph& graph = state.Graph();
  for (Node node = graph.first_node[image]; node < graph.first_node[image + 1]; ++node) {
    bool visible = false;
    for (const Node other : graph.Neighbours(node)) visible |= state.PointOf(other) != kNoPoint;
    count += visible ? 1 : 0;
  }
  return count;
}

uint32_t CountObservations(const MappingState& state, ImageSlot image) {
  uint32_t count = 0;
  const CorrespondenceGraph& graph = state.Graph();
  for (Node node = graph.first_node[image]; node < graph.first_node[image + 1]; ++node) {
    count += state.PointOf(node) != kNoPoint ? 1 : 0;
  }
  return count;
}

void ExpectConsistent(const MappingState& state) {
  uint32_t points = 0;
  uint32_t observations = 0;
  for (PointIndex point = 0; point < state.EndOfPoints(); ++point) {
    if (!state.Exists(point)) continue;
    ++points;
    std::vector<ImageSlot> images;
    for (const Node node : state.Point(point).nodes) {
      EXPECT_EQ(state.PointOf(node), point);
      images.push_back(state.Graph().image_of_node[node]);
      EXPECT_TRUE(state.IsRegistered(images.back()));
    }
    EXPECT_GE(images.size(), 2U);
    std::ranges::sort(images);
    EXPECT_EQ(std::ranges::adjacent_find(images), images.end());
    observations += static_cast<uint32_t>(images.size());
  }
  EXPECT_EQ(state.NumPoints(), points);
  EXPECT_EQ(state.NumObservations(), observations);
  for (ImageSlot image = 0; image < state.Graph().NumImages(); ++image) {
    EXPECT_EQ(state.Visible(image).Count(), CountVisible(state, image));
    EXPECT_EQ(state.NumObservations(image), CountObservations(state, image));
  }
}

TEST(MappingState, StaysConsistentWhilePointsComeAndGo) {
  const StreetFixture street({.centres = StraightWalk(8, 3.0), .outlier_share = 0.1});
  MappingState state = street.TriangulatedStateWith(FirstImages(6));
  ASSERT_GT(state.NumPoints(), 50U);
  ExpectConsistent(state);
  for (PointIndex point = 0; point < state.EndOfPoints(); point += 3) state.RemovePoint(point);
  ExpectConsistent(state);
  for (PointIndex point = 1; point < state.EndOfPoints(); point += 3) {
    state.RemoveObservation(point, state.Point(point).nodes.back());
  }
  ExpectConsistent(state);
  state.Deregister(2);
  EXPECT_FALSE(state.IsRegistered(2));
  EXPECT_EQ(state.NumObservations(2), 0U);
  ExpectConsistent(state);
}

TEST(MappingState, RemovingTheSecondObservationRemovesThePoint) {
  const StreetFixture street({.centres = StraightWalk(2, 3.0)});
  MappingState state = street.TriangulatedStateWith({0, 1});
  const uint32_t points = state.NumPoints();
  EXPECT_EQ(state.RemoveObservation(0, state.Point(0).nodes.front()), 2U);
  EXPECT_FALSE(state.Exists(0));
  EXPECT_EQ(state.NumPoints(), points - 1);
}

TEST(IsWellSeen, RefusesPointsFarAwayAndOnTheBaseline) {
  const StreetFixture street({.centres = StraightWalk(2, 3.0)});
  const MappingState state = street.StateWith({0, 1});
  const std::vector<Node> nodes = {street.graph.node_of_feature[0][0],
                                   street.graph.node_of_feature[1][0]};
  constexpr double kMinAngle = 0.03;
  EXPECT_TRUE(IsWellSeen(state, {1.5, 0.0, 4.0}, nodes, kMinAngle));
  EXPECT_FALSE(IsWellSeen(state, {1.5, 0.0, 400.0}, nodes, kMinAngle));
  EXPECT_FALSE(IsWellSeen(state, {1.5, 0.0, 1e-3}, nodes, kMinAngle));
  EXPECT_FALSE(IsWellSeen(state, {9.0, 0.0, 1e-3}, nodes, kMinAngle));
}

TEST(NodeError, IsPiForAPointBehindTheBearing) {
  const StreetFixture street({.centres = StraightWalk(2, 3.0)});
  const MappingState state = street.StateWith({0, 1});
  const Node node = street.graph.node_of_feature[0][0];
  const Eigen::Vector3d ray = street.graph.bearing_of_node[node];
  EXPECT_NEAR(NodeError(state, 5.0 * ray, node), 0.0, 1e-12);
  EXPECT_NEAR(NodeError(state, -5.0 * ray, node), std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace orbweave
