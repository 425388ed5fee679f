// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/step_witness.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/gnss_walk.h"

namespace orbweave {
namespace {

constexpr ImageSlot kImage = 6;

double MisfitFurther(const GnssWalk& walk, double metres) {
  const MappingState state = walk.StateWithout(kImage);
  const std::optional<double> misfit =
      StepWitness(state, kImage).Misfit(walk.Further(kImage, metres).Centre());
  EXPECT_TRUE(misfit.has_value());
  return misfit.value_or(-1.0);
}

TEST(StepWitness, TellsAStepOfAHouseTooMany) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const GnssWalk walk(seed);
    EXPECT_LT(MisfitFurther(walk, 0.0), 2.0) << "seed " << seed;
    EXPECT_GT(MisfitFurther(walk, 7.0), 2.0) << "seed " << seed;
    EXPECT_GT(MisfitFurther(walk, -7.0), 2.0) << "seed " << seed;
  }
}

TEST(StepWitness, DoesNotKnowTheFrameOfTheModel) {
  GnssWalk walk;
  const double before = MisfitFurther(walk, 5.0);
  walk.model_from_world = {7.0, RotationFromVector({-2.0, 0.3, 1.0}), {40.0, 2.0, -9.0}};
  EXPECT_NEAR(MisfitFurther(walk, 5.0), before, 1e-6);
}

TEST(StepWitness, IsNotMisledByOnePositionAround) {
  GnssWalk walk;
  *walk.Prior(5).position_in_enu += Eigen::Vector3d(30.0, 40.0, 0.0);
  EXPECT_LT(MisfitFurther(walk, 0.0), 2.0);
  EXPECT_GT(MisfitFurther(walk, 7.0), 2.0);
}

TEST(StepWitness, MeasuresWhatPositionsAreWorth) {
  GnssWalk walk;
  for (uint32_t image = 0; image < GnssWalk::kImages; ++image)
    walk.Prior(image).horizontal_sigma_m = 0.02;
  EXPECT_LT(MisfitFurther(walk, 0.0), 2.0);
  EXPECT_GT(MisfitFurther(walk, 7.0), 2.0);
}

TEST(StepWitness, IsNotMisledByStepsThatAreWrongInOneWay) {
  const GnssWalk walk;
  MappingState state = walk.StateWithout(kImage);
  for (ImageSlot image = 9; image < GnssWalk::kImages; ++image)  // a third, shortened to a half
    state.SetPose(image, walk.Further(image, -4.0 * (image - 8.0)));
  EXPECT_FALSE(StepWitness(state, kImage).Contradicts(walk.InModel(kImage).Centre()));
  EXPECT_GT(StepWitness(state, 11).Misfit(state.Centre(11)).value(), 2.0);
}

/// Steps within a drive are exact, and its own bias is in every step from one to the other.
TEST(StepWitness, DrivesShareNothing) {
  GnssWalk walk;
  walk.SetExactPositions();
  *walk.Prior(kImage).position_in_enu += Eigen::Vector3d(2.0, 0.0, 0.0);
  EXPECT_GT(MisfitFurther(walk, 0.0), 2.0);
  walk.Image(kImage).drive = 1;
  EXPECT_LT(MisfitFurther(walk, 0.0), 2.0);
  EXPECT_GT(MisfitFurther(walk, -7.0), 2.0);
}

TEST(StepWitness, SaysNothingWithoutPositions) {
  GnssWalk walk;
  walk.Prior(kImage).position_in_enu.reset();
  const MappingState state = walk.StateWithout(kImage);
  const StepWitness witness(state, kImage);
  EXPECT_FALSE(witness.Misfit(Eigen::Vector3d::Zero()).has_value());
  EXPECT_FALSE(witness.Contradicts(Eigen::Vector3d::Zero()));
  EXPECT_FALSE(witness.Supports(Eigen::Vector3d::Zero()));
  for (uint32_t image = 0; image < GnssWalk::kImages; ++image)
    walk.Prior(image).position_in_enu.reset();
  walk.Prior(kImage).position_in_enu = walk.TrueInEnu(kImage);
  EXPECT_FALSE(
      StepWitness(walk.StateWithout(kImage), kImage).Misfit(Eigen::Vector3d::Zero()).has_value());
}

TEST(StepWitness, RestsOnTheNearest) {
  const GnssWalk walk;
  const MappingState state = walk.StateWithout(kImage);
  const std::vector<ImageSlot> witnesses = StepWitness(state, kImage).Witnesses();
  ASSERT_EQ(witnesses.size(), 5U);
  for (const ImageSlot image : witnesses)
    EXPECT_LE(std::abs(static_cast<int>(image) - static_cast<int>(kImage)), 3);
}

}  // namespace
}  // namespace orbweave
