// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/filter_points.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

TEST(FilterPoints, KeepsCleanPoints) {
  const StreetFixture street({.centres = StraightWalk(5, 3.0), .noise_px = 0.3});
  MappingState state = street.TriangulatedStateWith(FirstImages(5));
  const uint32_t points = state.NumPoints();
  EXPECT_EQ(FilterPoints(state, AllPoints(state), TrackLimits{}), 0U);
  EXPECT_EQ(state.NumPoints(), points);
}

TEST(FilterPoints, RemovesTheObservationsOfADisplacedImage) {
  const StreetFixture street({.centres = StraightWalk(5, 3.0), .noise_px = 0.3});
  MappingState state = street.TriangulatedStateWith(FirstImages(5));
  Rigid3 moved = state.CamFromWorld(2);
  moved.rotation = moved.rotation * RotationFromVector({0.0, 0.05, 0.0});
  state.SetPose(2, moved);
  const uint32_t before = state.NumObservations();
  const uint32_t removed = FilterPoints(state, AllPoints(state), TrackLimits{});
  EXPECT_EQ(state.NumObservations(), before - removed);
  EXPECT_LT(state.NumObservations(2), 5U);
  EXPECT_GT(state.NumObservations(1), 20U);
}

TEST(FilterPoints, RemovesPointsBehindTheirBearings) {
  const StreetFixture street({.centres = StraightWalk(2, 3.0), .noise_px = 0.0});
  MappingState state = street.TriangulatedStateWith({0, 1});
  const Eigen::Vector3d midpoint(1.5, 0.0, 0.0);
  state.SetPosition(0, midpoint - (state.Point(0).position - midpoint));
  FilterPoints(state, AllPoints(state), TrackLimits{});
  EXPECT_FALSE(state.Exists(0));
}

TEST(FilterPoints, RemovesPointsThatAreNotNumbers) {
  const StreetFixture street({.centres = StraightWalk(2, 3.0)});
  MappingState state = street.TriangulatedStateWith({0, 1});
  state.SetPosition(0, Eigen::Vector3d::Constant(std::nan("")));
  FilterPoints(state, AllPoints(state), TrackLimits{});
  EXPECT_FALSE(state.Exists(0));
}

TEST(FilterPoints, RemovesPointsUnderSmallAngles) {
  const StreetFixture street({.centres = StraightWalk(3, 3.0)});
  MappingState state = street.TriangulatedStateWith(FirstImages(3));
  FilterPoints(state, AllPoints(state), {.min_angle_deg = 20.0});
  for (const PointIndex point : AllPoints(state)) {
    EXPECT_TRUE(IsWellSeen(state, state.Point(point).position, state.Point(point).nodes, 0.349));
  }
}

TEST(IsWellSeen, OneImageAloneMayNotSeeItFromCloseUp) {
  const StreetFixture street({.centres = StraightWalk(2, 3.0)});
  const MappingState state = street.TriangulatedStateWith({0, 1});
  const std::vector<Node> both = state.Point(0).nodes;
  const Eigen::Vector3d aside = (state.Centre(1) - state.Centre(0)).unitOrthogonal();
  EXPECT_TRUE(IsWellSeen(state, state.Centre(0) + 0.3 * aside, both, 0.1));
  EXPECT_FALSE(IsWellSeen(state, state.Centre(0) + 0.1 * aside, both, 0.1));
  EXPECT_FALSE(IsWellSeen(state, state.Centre(0), both, 0.1));
}

}  // namespace
}  // namespace orbweave
