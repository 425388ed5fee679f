// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/drop_near_points.h"

#include <gtest/gtest.h>

#include "core/mapping/model/filter_points.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

RayStreetOptions Walk() { return {.centres = StraightWalk(6, 3.0), .noise_px = 0.0}; }

TEST(DropNearPoints, KeepsPointsOfAStreet) {
  const StreetFixture street(Walk());
  MappingState state = street.TriangulatedStateWith(FirstImages(6));
  ASSERT_GT(state.NumPoints(), 50U);
  EXPECT_EQ(DropNearPoints(state, state.Registered()), 0U);
}

TEST(DropNearPoints, RemovesWhatLiesAtACamera) {
  const StreetFixture street(Walk());
  MappingState state = street.TriangulatedStateWith(FirstImages(6));
  const PointIndex point = AllPoints(state).front();
  const ImageSlot image = street.graph.image_of_node[state.Point(point).nodes.front()];
  state.SetPosition(point, state.Centre(image) + Eigen::Vector3d(0.01, 0.0, 0.02));
  const auto seen = static_cast<uint32_t>(state.Point(point).nodes.size());
  const uint32_t before = state.NumPoints();
  EXPECT_EQ(DropNearPoints(state, state.Registered()), seen);
  EXPECT_FALSE(state.Exists(point));
  EXPECT_EQ(state.NumPoints(), before - 1);
}

TEST(DropNearPoints, LeavesImagesAloneThatAreNotNamed) {
  const StreetFixture street(Walk());
  MappingState state = street.TriangulatedStateWith(FirstImages(6));
  const PointIndex point = AllPoints(state).front();
  const ImageSlot image = street.graph.image_of_node[state.Point(point).nodes.front()];
  state.SetPosition(point, state.Centre(image) + Eigen::Vector3d(0.01, 0.0, 0.02));
  for (const ImageSlot other : FirstImages(6)) {
    if (other == image) continue;
    EXPECT_EQ(DropNearPoints(state, {&other, 1}), 0U);
  }
}

TEST(DropNearPoints, DoesNotKnowAScale) {
  const StreetFixture street(Walk());
  MappingState state = street.TriangulatedStateWith(FirstImages(6));
  Scale(state, 1e-6);
  EXPECT_EQ(DropNearPoints(state, state.Registered()), 0U);
}

}  // namespace
}  // namespace orbweave
