// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/adjustment/level_cameras.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

TEST(LevelSigma, IsADegreeAtLeastForCamerasThatStandUpright) {
  const StreetFixture street({.centres = StraightWalk(20, 3.0)});
  const auto sigma = LevelSigma(street.world.problem, street.graph);
  ASSERT_TRUE(sigma.has_value());
  EXPECT_NEAR(*sigma, kRadPerDeg, 1e-12);
}

TEST(LevelSigma, IsHowPairsLean) {
  StreetFixture street({.centres = StraightWalk(20, 3.0)});
  Random random(1);
  for (TwoViewGeometry& pair : street.world.problem.pairs) {
    const double sigma_rad = 1.6 * kRadPerDeg * std::numbers::sqrt2;
    const Vector3d lean(random.Normal(), 0.0, random.Normal());
    pair.b_from_a.rotation = RotationFromVector(sigma_rad * lean) * pair.b_from_a.rotation;
  }
  const auto sigma = LevelSigma(street.world.problem, street.graph);
  ASSERT_TRUE(sigma.has_value());
  EXPECT_NEAR(*sigma, 1.6 * kRadPerDeg, 0.3 * kRadPerDeg);
}

TEST(LevelSigma, SaysNothingOfPanoramasTurnedAnyhow) {
  const StreetFixture street({.centres = StraightWalk(20, 3.0), .random_rotations = true});
  EXPECT_FALSE(LevelSigma(street.world.problem, street.graph).has_value());
}

/// The 40 images of a street, rolled by `step_rad` more from one to the next, none in the middle.
MappingState Rolled(const StreetFixture& street, double step_rad) {
  MappingState state = street.StateWith(FirstImages(40));
  for (ImageSlot image = 0; image < 40; ++image) {
    const Rigid3& truth = street.world.cams_from_world[image];
    const double roll_rad = step_rad * (image - 20.0);
    state.SetPose(
        image,
        Rigid3::FromCentre(RotationFromVector(roll_rad * Vector3d::UnitZ()) * truth.rotation,
                           truth.Centre()));
  }
  return state;
}

TEST(AddLevelPriors, PullsBackWhatLeans) {
  const StreetFixture street({.centres = StraightWalk(40, 3.0)});
  MappingState state = Rolled(street, 0.3 * kRadPerDeg);
  state.SetLevelSigma(kRadPerDeg);
  BundleProblem problem;
  for (const ImageSlot image : state.Registered())
    problem.cams_from_world.push_back(state.CamFromWorld(image));
  AddLevelPriors(state, state.Registered(), problem);
  ASSERT_EQ(problem.direction_priors.size(), 40U);
  const DirectionPrior& first = problem.direction_priors.front();
  const double lean_rad = AngleBetween(state.CamFromWorld(0).rotation * first.direction_in_world,
                                       first.direction_in_cam);
  EXPECT_NEAR(lean_rad, 6.0 * kRadPerDeg, 0.5 * kRadPerDeg);
  const double upright_rad = problem.direction_priors[20].sigma_rad;
  EXPECT_NEAR(upright_rad, std::hypot(1.0, std::sqrt(90.0)) * kRadPerDeg, 0.01 * kRadPerDeg);
  EXPECT_GT(first.sigma_rad, 1.01 * upright_rad) << "what leans far counts for less";
}

TEST(AddLevelPriors, AddsNothingWithoutSigma) {
  const StreetFixture street({.centres = StraightWalk(40, 3.0)});
  const MappingState state = Rolled(street, 0.3 * kRadPerDeg);
  BundleProblem problem;
  AddLevelPriors(state, state.Registered(), problem);
  EXPECT_TRUE(problem.direction_priors.empty());
}

TEST(AddLevelPriors, LearnsHowTheMountOfADriveLeans) {
  // There and back, with cameras that lean by ten degrees in their own axes.
  StreetFixture street({.centres = StraightWalk(20, 3.0)});
  MappingState state = street.StateWith(FirstImages(20));
  const Eigen::Quaterniond mount = RotationFromVector({10.0 * kRadPerDeg, 0.0, 0.0});
  const Eigen::Quaterniond back = RotationFromVector({0.0, std::numbers::pi, 0.0});
  for (ImageSlot image = 0; image < 20; ++image) {
    const Rigid3& truth = street.world.cams_from_world[image];
    const Eigen::Quaterniond turn = image < 10 ? Eigen::Quaterniond::Identity() : back;
    state.SetPose(image, Rigid3::FromCentre(mount * turn * truth.rotation, truth.Centre()));
  }
  const auto frame = FindLevelFrame(state);
  ASSERT_TRUE(frame.has_value());
  EXPECT_LT(AngleBetween(frame->up_in_world, -Vector3d::UnitY()), 1.0 * kRadPerDeg);
  const Vector3d leaning = mount * -Vector3d::UnitY();
  EXPECT_LT(AngleBetween(frame->up_in_cam.at(0), leaning), 2.5 * kRadPerDeg);
}

}  // namespace
}  // namespace orbweave
