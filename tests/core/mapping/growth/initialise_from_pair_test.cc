// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/growth/initialise_from_pair.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

TEST(InitialiseFromPair, RecoversTheRelativePose) {
  const StreetFixture street(
      {.centres = StraightWalk(2, 3.0), .points_per_metre = 40, .noise_px = 0.0});
  MappingState state = street.StateWith({});
  ASSERT_TRUE(InitialiseFromPair(state, street.graph.pairs[0], {}, {}).value());
  const Rigid3 b_from_a = state.CamFromWorld(1) * state.CamFromWorld(0).Inverse();
  const Rigid3 truth = street.world.cams_from_world[1] * street.world.cams_from_world[0].Inverse();
  EXPECT_LT(RotationAngle(b_from_a.rotation * truth.rotation.conjugate()), 1e-6);
  EXPECT_LT(AngleBetween(b_from_a.translation, truth.translation), 1e-6);
}

TEST(InitialiseFromPair, RefusesAWrongRelativePose) {
  StreetFixture street({.centres = StraightWalk(2, 3.0), .points_per_metre = 40});
  street.world.problem.pairs[0].b_from_a.translation = Eigen::Vector3d::UnitY();
  street.world.problem.pairs[0].b_from_a.rotation =
      RotationFromVector({0.4, 0.0, 0.0}) * street.world.problem.pairs[0].b_from_a.rotation;
  MappingState state = street.StateWith({});
  EXPECT_FALSE(InitialiseFromPair(state, street.graph.pairs[0], {}, {}).value());
}

TEST(InitialiseFromPair, RefusesABaselineTooShortToSeeDepth) {
  StreetFixture street({.centres = StraightWalk(2, 0.02), .points_per_metre = 80, .noise_px = 0.3});
  MappingState state = street.StateWith({});
  EXPECT_FALSE(InitialiseFromPair(state, street.graph.pairs[0], {}, {}).value());
}

}  // namespace
}  // namespace orbweave
