// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/pose_from_pairs.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

/// The correspondences of `image`, only every `stride`-th.
SceneCorrespondences Thinned(const MappingState& state, ImageSlot image, size_t stride) {
  const SceneCorrespondences all = FindSceneCorrespondences(state, image);
  SceneCorrespondences few;
  for (size_t i = 0; i < all.size(); i += stride) {
    few.nodes.push_back(all.nodes[i]);
    few.points.push_back(all.points[i]);
    few.bearings.push_back(all.bearings[i]);
    few.positions.push_back(all.positions[i]);
  }
  return few;
}

constexpr double kMaxErrorRad = 4.0 * 2.0 * std::numbers::pi / 5400.0;

TEST(EstimatePoseFromPairs, NeedsAHandfulOfPoints) {
  const StreetFixture street(
      {.centres = StraightWalk(4, 3.0), .noise_px = 0.2, .random_rotations = true});
  const MappingState state = street.TriangulatedStateWith({0, 1, 2});
  const SceneCorrespondences few = Thinned(state, 3, 12);
  ASSERT_LT(few.size(), 20U);
  const auto pose = EstimatePoseFromPairs(state, 3, few, kMaxErrorRad);
  ASSERT_TRUE(pose.has_value());
  const Rigid3& truth = street.world.cams_from_world[3];
  EXPECT_LT((pose->Centre() - truth.Centre()).norm(), 0.05);
  EXPECT_LT(RotationAngle(pose->rotation * truth.rotation.conjugate()), 5e-3);
}

TEST(EstimatePoseFromPairs, KeepsTheCentreUnderPureRotation) {
  std::vector<Eigen::Vector3d> centres = StraightWalk(3, 3.0);
  centres.push_back(centres.back());
  const StreetFixture street({.centres = centres, .noise_px = 0.2, .random_rotations = true});
  const MappingState state = street.TriangulatedStateWith({0, 1, 2});
  const auto pose = EstimatePoseFromPairs(state, 3, Thinned(state, 3, 10), kMaxErrorRad);
  ASSERT_TRUE(pose.has_value());
  EXPECT_LT((pose->Centre() - centres.back()).norm(), 0.05);
}

TEST(EstimatePoseFromPairs, HasNoAnswerWithoutARegisteredNeighbour) {
  const StreetFixture street({.centres = StraightWalk(4, 3.0)});
  const MappingState state = street.StateWith({});
  EXPECT_FALSE(EstimatePoseFromPairs(state, 3, {}, kMaxErrorRad).has_value());
}

}  // namespace
}  // namespace orbweave
