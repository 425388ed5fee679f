// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/scene_correspondences.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

constexpr double kMaxErrorRad = 4.0 * 2.0 * std::numbers::pi / 5400.0;

TEST(FindSceneCorrespondences, ListsWhatTheImageSeesOnce) {
  const StreetFixture street({.centres = StraightWalk(4, 3.0), .noise_px = 0.1});
  const MappingState state = street.TriangulatedStateWith({0, 1, 2});
  const SceneCorrespondences found = FindSceneCorrespondences(state, 3);
  ASSERT_GT(found.size(), 20U);
  EXPECT_EQ(found.size(), state.Visible(3).Count());
  for (size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(street.TruePoint(found.nodes[i]),
              street.TruePoint(state.Point(found.points[i]).nodes.front()));
    EXPECT_EQ(found.positions[i], state.Point(found.points[i]).position);
    EXPECT_EQ(found.bearings[i], street.graph.bearing_of_node[found.nodes[i]]);
  }
}

TEST(SupportOf, CountsDifferentFeaturesAndPoints) {
  const StreetFixture street({.centres = StraightWalk(4, 3.0), .noise_px = 0.1});
  const MappingState state = street.TriangulatedStateWith({0, 1, 2});
  SceneCorrespondences found = FindSceneCorrespondences(state, 3);
  const Rigid3& truth = street.world.cams_from_world[3];
  const uint32_t count = SupportOf(truth, found, kMaxErrorRad).count;
  EXPECT_GE(count, 0.95 * static_cast<double>(found.size()));
  // The same pairs once more support nothing new.
  const size_t size = found.size();
  for (size_t i = 0; i < size; ++i) {
    found.nodes.push_back(found.nodes[i]);
    found.points.push_back(found.points[i]);
    found.bearings.push_back(found.bearings[i]);
    found.positions.push_back(found.positions[i]);
  }
  EXPECT_EQ(SupportOf(truth, found, kMaxErrorRad).count, count);
}

TEST(SupportOf, AWrongPoseHasNone) {
  const StreetFixture street({.centres = StraightWalk(4, 3.0), .noise_px = 0.1});
  const MappingState state = street.TriangulatedStateWith({0, 1, 2});
  Rigid3 wrong = street.world.cams_from_world[3];
  wrong.rotation = wrong.rotation * RotationFromVector({0.0, 0.5, 0.0});
  EXPECT_LE(SupportOf(wrong, FindSceneCorrespondences(state, 3), kMaxErrorRad).count, 2U);
}

}  // namespace
}  // namespace orbweave
