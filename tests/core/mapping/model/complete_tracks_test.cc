// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/complete_tracks.h"

#include <gtest/gtest.h>

#include "core/mapping/model/filter_points.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

TEST(CompleteTracks, BringsBackRemovedObservationsThroughMatches) {
  const StreetFixture street({.centres = StraightWalk(6, 3.0), .noise_px = 0.1});
  MappingState state = street.TriangulatedStateWith(FirstImages(6));
  const uint32_t before = state.NumObservations();
  for (const PointIndex point : AllPoints(state)) {
    while (state.Point(point).nodes.size() > 2) {
      state.RemoveObservation(point, state.Point(point).nodes.back());
    }
  }
  ASSERT_LT(state.NumObservations(), before);
  const uint32_t added = CompleteTracks(state, AllPoints(state), 4.0);
  EXPECT_GT(added, 0U);
  EXPECT_GE(state.NumObservations(), 0.95 * before);
}

TEST(CompleteTracks, FollowsMatchesOfWhatItAdded) {
  // Matches join direct successors only: image 2 is reached from images 0 and 1 step by step.
  const StreetFixture street({.centres = StraightWalk(5, 2.0), .window = 1, .noise_px = 0.0});
  MappingState state = street.TriangulatedStateWith({0, 1});
  const uint32_t longest_before = 2;
  for (const ImageSlot image : {2U, 3U, 4U})
    state.Register(image, street.world.cams_from_world[image]);
  CompleteTracks(state, AllPoints(state), 4.0);
  size_t longest = 0;
  for (const PointIndex point : AllPoints(state)) {
    longest = std::max(longest, state.Point(point).nodes.size());
  }
  EXPECT_GT(longest, longest_before + 1);
}

TEST(CompleteTracks, AddsNothingThatDisagrees) {
  const StreetFixture street({.centres = StraightWalk(3, 3.0), .noise_px = 0.0});
  MappingState state = street.TriangulatedStateWith({0, 1});
  Rigid3 wrong = street.world.cams_from_world[2];
  wrong.rotation = wrong.rotation * RotationFromVector({0.0, 0.3, 0.0});
  state.Register(2, wrong);
  EXPECT_EQ(CompleteTracks(state, AllPoints(state), 4.0), 0U);
}

}  // namespace
}  // namespace orbweave
