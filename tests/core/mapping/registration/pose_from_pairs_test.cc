// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/pose_from_pairs.h"

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

std::optional<PoseFromPairs> Estimate(const MappingState& state,
                                      ImageSlot image,
                                      const SceneCorrespondences& correspondences) {
  return EstimatePoseFromPairs(
      state, image, MatchesWithRegistered(state, image), correspondences, kMaxErrorRad);
}

TEST(EstimatePoseFromPairs, NeedsAHandfulOfPoints) {
  const StreetFixture street(
      {.centres = StraightWalk(4, 3.0), .noise_px = 0.2, .random_rotations = true});
  const MappingState state = street.TriangulatedStateWith({0, 1, 2});
  const SceneCorrespondences few = Thinned(state, 3, 12);
  ASSERT_LT(few.size(), 20U);
  const auto pose = Estimate(state, 3, few);
  ASSERT_TRUE(pose.has_value());
  const Rigid3& truth = street.world.cams_from_world[3];
  EXPECT_LT((pose->cam_from_world.Centre() - truth.Centre()).norm(), 0.05);
  EXPECT_LT(RotationAngle(pose->cam_from_world.rotation * truth.rotation.conjugate()), 5e-3);
}

TEST(EstimatePoseFromPairs, KeepsTheCentreUnderPureRotation) {
  std::vector<Eigen::Vector3d> centres = StraightWalk(3, 3.0);
  centres.push_back(centres.back());
  const StreetFixture street({.centres = centres, .noise_px = 0.2, .random_rotations = true});
  const MappingState state = street.TriangulatedStateWith({0, 1, 2});
  const auto pose = Estimate(state, 3, Thinned(state, 3, 10));
  ASSERT_TRUE(pose.has_value());
  EXPECT_LT((pose->cam_from_world.Centre() - centres.back()).norm(), 0.05);
}

TEST(EstimatePoseFromPairs, NeedsNoPointWhereTwoDirectionsCross) {
  const StreetFixture street({.centres = {{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {2.0, 3.0, 0.0}},
                              .noise_px = 0.2,
                              .random_rotations = true});
  const MappingState state = street.StateWith({0, 1});
  const auto pose = Estimate(state, 2, {});
  ASSERT_TRUE(pose.has_value());
  EXPECT_TRUE(IsHeldByPairs(*pose, 20));
  EXPECT_GT(pose->crossing_angle_rad, 0.5);
  EXPECT_EQ(pose->points.count, 0U);
  const Rigid3& truth = street.world.cams_from_world[2];
  EXPECT_LT((pose->cam_from_world.Centre() - truth.Centre()).norm(), 0.05);
}

TEST(IsHeldByPairs, AsksForTheLengthOfTheBaseline) {
  // On a straight street all directions are parallel: without points nothing says how far.
  const StreetFixture street(
      {.centres = StraightWalk(4, 3.0), .noise_px = 0.2, .random_rotations = true});
  const MappingState state = street.TriangulatedStateWith({0, 1, 2});
  const auto held = Estimate(state, 3, Thinned(state, 3, 20));
  ASSERT_TRUE(held.has_value());
  EXPECT_TRUE(IsHeldByPairs(*held, 20));
  EXPECT_LT(held->log10_false_alarms, -4.0);
  SceneCorrespondences two = Thinned(state, 3, 20);
  for (auto* values : {&two.bearings, &two.positions}) values->resize(2);
  two.nodes.resize(2);
  two.points.resize(2);
  const auto open = Estimate(state, 3, two);
  EXPECT_FALSE(open.has_value() && IsHeldByPairs(*open, 20));
}

TEST(IsHeldByPairs, RefusesAPoseThatMostMatchesContradict) {
  PoseFromPairs pose{.num_matches = 200, .agreeing_matches = 99, .log10_false_alarms = -20.0};
  EXPECT_FALSE(IsHeldByPairs(pose, 20));
  pose.agreeing_matches = 101;
  EXPECT_TRUE(IsHeldByPairs(pose, 20));
  EXPECT_FALSE(IsHeldByPairs(pose, 102));
}

TEST(EstimatePoseFromPairs, HasNoAnswerWithoutARegisteredNeighbour) {
  const StreetFixture street({.centres = StraightWalk(4, 3.0)});
  const MappingState state = street.StateWith({});
  EXPECT_FALSE(Estimate(state, 3, {}).has_value());
}

}  // namespace
}  // namespace orbweave
