// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/triangulate_tracks.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

TEST(TriangulateImage, FindsEveryWellSeenPointOfCleanRays) {
  const StreetFixture street({.centres = StraightWalk(4, 3.0), .noise_px = 0.0});
  const MappingState state = street.TriangulatedStateWith(FirstImages(4));
  EXPECT_GT(state.NumPoints(), 60U);
  for (PointIndex point = 0; point < state.EndOfPoints(); ++point) {
    for (const Node node : state.Point(point).nodes) {
      EXPECT_EQ(street.TruePoint(node), street.TruePoint(state.Point(point).nodes.front()));
      EXPECT_LT(NodeError(state, state.Point(point).position, node), 1e-9);
    }
  }
}

TEST(TriangulateImage, ContinuesPointsInsteadOfDoublingThem) {
  const StreetFixture street({.centres = StraightWalk(5, 3.0)});
  MappingState state = street.TriangulatedStateWith({0, 1, 2, 3});
  const uint32_t points = state.NumPoints();
  state.Register(4, street.world.cams_from_world[4]);
  const uint32_t added = TriangulateImage(state, 4, TrackLimits{});
  EXPECT_GT(added, points / 4);
  std::vector<int> seen;
  for (PointIndex point = 0; point < state.EndOfPoints(); ++point) {
    seen.push_back(street.TruePoint(state.Point(point).nodes.front()));
  }
  std::ranges::sort(seen);
  EXPECT_EQ(std::ranges::adjacent_find(seen), seen.end());
}

TEST(TriangulateImage, KeepsWrongMatchesOut) {
  const StreetFixture street({.centres = StraightWalk(6, 3.0), .outlier_share = 0.3});
  const MappingState state = street.TriangulatedStateWith(FirstImages(6));
  uint32_t wrong = 0;
  for (PointIndex point = 0; point < state.EndOfPoints(); ++point) {
    for (const Node node : state.Point(point).nodes) {
      wrong += street.TruePoint(node) != street.TruePoint(state.Point(point).nodes.front()) ? 1 : 0;
    }
  }
  EXPECT_LT(wrong, 0.03 * state.NumObservations());
}

TEST(CreatePoint, RefusesNearlyParallelRays) {
  const StreetFixture street({.centres = StraightWalk(2, 0.02), .points_per_metre = 40});
  const MappingState state = street.TriangulatedStateWith({0, 1});
  EXPECT_EQ(state.NumPoints(), 0U);
}

TEST(ContinueTrack, RefusesASecondFeatureOfAnImage) {
  const StreetFixture street({.centres = StraightWalk(3, 3.0), .noise_px = 0.0});
  MappingState state = street.TriangulatedStateWith({0, 1, 2});
  const CorrespondenceGraph& graph = street.graph;
  for (Node node = 0; node < graph.NumNodes(); ++node) {
    if (state.PointOf(node) == kNoPoint || state.Point(state.PointOf(node)).nodes.size() < 3)
      continue;
    const PointIndex point = state.PointOf(node);
    state.RemoveObservation(point, node);
    EXPECT_TRUE(ContinueTrack(state, node, TrackLimits{}));
    EXPECT_EQ(state.PointOf(node), point);
    EXPECT_TRUE(state.IsSeenBy(point, graph.image_of_node[node]));
    return;
  }
  FAIL() << "no point of three images";
}

}  // namespace
}  // namespace orbweave
