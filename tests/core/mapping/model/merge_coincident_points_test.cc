// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/merge_coincident_points.h"

#include <gtest/gtest.h>

#include <set>

#include "core/mapping/model/filter_points.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

/// A street whose matches do not join images {0, 1, 2} with {4, 5, 6}, except through image 3,
/// which is matched with all but whose tracks with the two sides are torn apart by hand.
MappingState TornAt(const StreetFixture& street, ImageSlot tear) {
  MappingState state = street.TriangulatedStateWith(FirstImages(7));
  for (const PointIndex point : AllPoints(state)) {
    std::vector<Node> before;
    std::vector<Node> after;
    for (const Node node : state.Point(point).nodes) {
      (street.graph.image_of_node[node] < tear ? before : after).push_back(node);
    }
    if (before.size() < 2 || after.size() < 2) continue;
    const Eigen::Vector3d position = state.Point(point).position;
    state.RemovePoint(point);
    state.AddPoint(position, before);
    state.AddPoint(position, after);
  }
  return state;
}

TEST(MergeCoincidentPoints, JoinsTracksThatWereTornApart) {
  const StreetFixture street({.centres = StraightWalk(7, 2.0), .noise_px = 0.3});
  const uint32_t whole = street.TriangulatedStateWith(FirstImages(7)).NumPoints();
  MappingState state = TornAt(street, 3);
  ASSERT_GT(state.NumPoints(), whole + 20);
  const uint32_t observations = state.NumObservations();
  const uint32_t merged = MergeCoincidentPoints(state, 4.0);
  EXPECT_GT(merged, 20U);
  EXPECT_LE(state.NumPoints(), whole + 3);
  EXPECT_EQ(state.NumObservations(), observations);
}

TEST(MergeCoincidentPoints, KeepsDifferentPointsApart) {
  const StreetFixture street(
      {.centres = StraightWalk(7, 2.0), .points_per_metre = 40, .noise_px = 0.3});
  MappingState state = TornAt(street, 3);
  MergeCoincidentPoints(state, 2.0);
  for (const PointIndex point : AllPoints(state)) {
    std::set<int> shown;
    for (const Node node : state.Point(point).nodes) shown.insert(street.TruePoint(node));
    EXPECT_EQ(shown.size(), 1U);
  }
}

}  // namespace
}  // namespace orbweave
