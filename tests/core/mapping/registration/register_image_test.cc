// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/register_image.h"

#include <gtest/gtest.h>

#include "core/mapping/registration/scene_correspondences.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

TEST(RegisterImage, RecoversThePoseFromScenePoints) {
  const StreetFixture street(
      {.centres = StraightWalk(5, 3.0), .noise_px = 0.3, .random_rotations = true});
  MappingState state = street.TriangulatedStateWith({0, 1, 2, 3});
  const RegistrationAttempt attempt = RegisterImage(state, 4, {}, {}).value();
  ASSERT_TRUE(attempt.registered);
  EXPECT_GE(attempt.num_inliers, 20U);
  const Rigid3& truth = street.world.cams_from_world[4];
  EXPECT_LT((state.Centre(4) - truth.Centre()).norm(), 0.02);
  EXPECT_LT(RotationAngle(state.CamFromWorld(4).rotation * truth.rotation.conjugate()), 2e-3);
}

TEST(RegisterImage, SaysHowManyPointsAgree) {
  const StreetFixture street({.centres = StraightWalk(5, 3.0)});
  MappingState state = street.TriangulatedStateWith({0, 1, 2, 3});
  const RegistrationAttempt attempt = RegisterImage(state, 4, {.min_inliers = 5000}, {}).value();
  EXPECT_FALSE(attempt.registered);
  EXPECT_FALSE(state.IsRegistered(4));
  EXPECT_GT(attempt.num_inliers, 20U);
  EXPECT_GE(attempt.num_visible, attempt.num_inliers);
}

TEST(RegisterImage, RefusesAnImageWhoseMatchesAreWrong) {
  StreetFixture street({.centres = StraightWalk(5, 3.0)});
  Random random(4);
  for (Node node = street.graph.first_node[4]; node < street.graph.first_node[5]; ++node) {
    street.graph.bearing_of_node[node] =
        Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized();
  }
  MappingState state = street.TriangulatedStateWith({0, 1, 2, 3});
  EXPECT_FALSE(RegisterImage(state, 4, {}, {}).value().registered);
}

/// Moves six in ten of the points that image 4 sees `shift` along the street, as if its windows had
/// been matched with others.
void ShiftPoints(const Eigen::Vector3d& shift, MappingState& state) {
  const SceneCorrespondences seen = FindSceneCorrespondences(state, 4);
  for (size_t i = 0; i < seen.size(); ++i) {
    if (i % 10 >= 6) continue;
    state.SetPosition(seen.points[i], seen.positions[i] + shift);
  }
}

TEST(RegisterImage, HeedsPairsWhereMostPointsAreAWindowTooFarAlong) {
  const StreetFixture street(
      {.centres = StraightWalk(5, 3.0), .noise_px = 0.3, .random_rotations = true});
  MappingState state = street.TriangulatedStateWith({0, 1, 2, 3});
  const Eigen::Vector3d step = state.Centre(3) - state.Centre(2);
  ShiftPoints(-2.0 * step, state);
  const Eigen::Vector3d truth = street.world.cams_from_world[4].Centre();
  MappingState blind = state;
  ASSERT_TRUE(RegisterImage(blind, 4, {.heeds_pairs = false}, {}).value().registered);
  EXPECT_GT((blind.Centre(4) - truth).norm(), 5.0);
  ASSERT_TRUE(RegisterImage(state, 4, {}, {}).value().registered);
  EXPECT_LT((state.Centre(4) - truth).norm(), 0.05);
}

/// One facade a window too far along, with most of the points, so that the image comes to stand
/// beyond the next one: pairs with those behind it agree with that as well, and what points say
/// elsewhere is little, but it is all other places.
TEST(RegisterImage, HeedsPairsAndPlacesWhereOneFacadeOutvotesAllOthers) {
  const StreetFixture street({.centres = StraightWalk(5, 3.0),
                              .points_per_metre = 60,
                              .noise_px = 0.3,
                              .random_rotations = true});
  MappingState state = street.TriangulatedStateWith({0, 1, 2, 4});
  const Eigen::Vector3d truth = street.world.cams_from_world[3].Centre();
  const SceneCorrespondences seen = FindSceneCorrespondences(state, 3);
  size_t elsewhere = 0;
  for (size_t i = 0; i < seen.size(); ++i) {
    const Eigen::Vector3d ray = seen.positions[i] - truth;
    if (ray.z() > 0.7 * ray.norm()) {
      state.SetPosition(seen.points[i], seen.positions[i] + Eigen::Vector3d(4.5, 0.0, 0.0));
    } else if (elsewhere++ % 9 != 0) {
      state.RemovePoint(seen.points[i]);
    }
  }
  MappingState blind = state;
  ASSERT_TRUE(RegisterImage(blind, 3, {.heeds_pairs = false}, {}).value().registered);
  EXPECT_GT((blind.Centre(3) - truth).norm(), 4.0);
  ASSERT_TRUE(RegisterImage(state, 3, {}, {}).value().registered);
  EXPECT_LT((state.Centre(3) - truth).norm(), 0.1);
}

TEST(RegisterImage, IsCancelledOnRequest) {
  const StreetFixture street({.centres = StraightWalk(5, 3.0)});
  MappingState state = street.TriangulatedStateWith({0, 1, 2, 3});
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(RegisterImage(state, 4, {}, {.stop = source.get_token()}).status().code(),
            absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
