// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/drop_two_view_points.h"

#include <gtest/gtest.h>

#include "core/mapping/model/filter_points.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

uint32_t CountOfLength(const MappingState& state, size_t length) {
  uint32_t count = 0;
  for (const PointIndex point : AllPoints(state)) {
    count += state.Point(point).nodes.size() == length ? 1 : 0;
  }
  return count;
}

/// A triangulated street of which every fourth point has lost all but two observations.
MappingState WithShortTracks(const StreetFixture& street) {
  MappingState state = street.TriangulatedStateWith(FirstImages(6));
  const std::vector<PointIndex> points = AllPoints(state);
  for (size_t i = 0; i < points.size(); i += 4) {
    while (state.Point(points[i]).nodes.size() > 2) {
      state.RemoveObservation(points[i], state.Point(points[i]).nodes.back());
    }
  }
  return state;
}

TEST(DropTwoViewPoints, KeepsExactOnesWhereImagesHaveFewOthers) {
  const StreetFixture street({.centres = StraightWalk(6, 3.0), .noise_px = 0.0});
  MappingState state = WithShortTracks(street);
  ASSERT_GT(CountOfLength(state, 2), 10U);
  EXPECT_EQ(DropTwoViewPoints(state, 1.0, 100000), 0U);
}

TEST(DropTwoViewPoints, RemovesThemWhereLongerTracksFillTheImages) {
  const StreetFixture street({.centres = StraightWalk(6, 3.0), .noise_px = 0.0});
  MappingState state = WithShortTracks(street);
  const uint32_t short_tracks = CountOfLength(state, 2);
  const uint32_t all_tracks = state.NumPoints();
  EXPECT_EQ(DropTwoViewPoints(state, 1.0, 0), short_tracks);
  EXPECT_EQ(state.NumPoints(), all_tracks - short_tracks);
}

TEST(DropTwoViewPoints, RemovesInexactOnesAnywhere) {
  const StreetFixture street({.centres = StraightWalk(6, 3.0), .noise_px = 0.0});
  MappingState state = WithShortTracks(street);
  for (const PointIndex point : AllPoints(state)) {
    if (state.Point(point).nodes.size() != 2) continue;
    state.SetPosition(point, state.Point(point).position + Eigen::Vector3d(0.0, 0.05, 0.0));
  }
  DropTwoViewPoints(state, 1.0, 100000);
  EXPECT_EQ(CountOfLength(state, 2), 0U);
}

}  // namespace
}  // namespace orbweave
