// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/position_misfit.h"

#include <gtest/gtest.h>

#include "core/mapping/lengths/matches_in_planes.h"
#include "tests/core/mapping/gnss_walk.h"

namespace orbweave {
namespace {

constexpr uint32_t kImages = GnssWalk::kImages;

MappingState StateOf(const GnssWalk& walk) { return walk.StateWithout(kImages); }

PositionMisfit MisfitOf(const MappingState& state) { return {state, 4.0 * kMatchTolerance}; }

double Sum(const PositionMisfit& misfit) { return misfit.Beside(misfit); }
double Mean(const PositionMisfit& misfit) { return misfit.MeanBeside(misfit); }

/// Images from `first` to `last` as many metres further along.
MappingState Slid(const GnssWalk& walk, ImageSlot first, ImageSlot last, double metres) {
  MappingState state = StateOf(walk);
  for (ImageSlot image = first; image <= last; ++image)
    state.SetPose(image, walk.Further(image, metres));
  return state;
}

TEST(PositionMisfit, IsTwoPerImageOfARightModelWhateverItsFrame) {
  double sum = 0.0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    GnssWalk walk(seed);
    const double misfit = Mean(MisfitOf(StateOf(walk)));
    sum += misfit;
    walk.model_from_world = {7.0, RotationFromVector({-2.0, 0.3, 1.0}), {40.0, 2.0, -9.0}};
    EXPECT_NEAR(Mean(MisfitOf(StateOf(walk))), misfit, 1e-6) << "seed " << seed;
  }
  EXPECT_GT(sum / 20.0, 1.0);
  EXPECT_LT(sum / 20.0, 2.5);
}

TEST(PositionMisfit, GrowsWhereImagesAreDrawnTogether) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const GnssWalk walk(seed);
    const MappingState right = StateOf(walk);
    MappingState drawn = right;
    for (ImageSlot image = 5; image <= 8; ++image)
      drawn.SetPose(image, walk.Further(image, -7.0 * (image - 4.0)));
    EXPECT_GT(MisfitOf(drawn).Beside(MisfitOf(right)),
              MisfitOf(right).Beside(MisfitOf(drawn)) + 20.0)
        << "seed " << seed;
  }
}

TEST(PositionMisfit, APositionThatIsFarOffSpeaksNoLouder) {
  GnssWalk walk;
  const double before = Sum(MisfitOf(StateOf(walk)));
  *walk.Prior(6).position_in_enu += Eigen::Vector3d(4000.0, 0.0, 0.0);
  EXPECT_LE(Sum(MisfitOf(StateOf(walk))), before + 9.0 + 3.0);
}

TEST(PositionMisfit, OfTwoModelsCountsWhatBothHave) {
  const GnssWalk walk;
  const MappingState right = StateOf(walk);
  MappingState most(walk.Fixture().world.problem, walk.Fixture().graph);
  for (ImageSlot image = 0; image < 11; ++image) most.Register(image, walk.InModel(image));
  const PositionMisfit of_right = MisfitOf(right);
  EXPECT_NEAR(Mean(of_right) * kImages, Sum(of_right), 1e-12);
  EXPECT_LT(of_right.Beside(MisfitOf(most)), Sum(of_right));
}

TEST(PositionMisfit, HoldsAWrongModelAgainstWhatTheRightOneMakesOfGnss) {
  const GnssWalk walk;
  const MappingState right = StateOf(walk);
  MappingState wrong = right;
  for (ImageSlot image = 0; image < kImages; ++image)
    wrong.SetPose(image, walk.Further(image, image % 2 == 0 ? 3.0 : -3.0));
  const PositionMisfit of_wrong = MisfitOf(wrong);
  EXPECT_GT(of_wrong.Beside(MisfitOf(right)), 1.5 * Sum(of_wrong));
}

TEST(PositionMisfit, SaysNothingFromFewPositions) {
  GnssWalk walk;
  for (uint32_t image = 9; image < kImages; ++image) walk.Prior(image).position_in_enu.reset();
  const PositionMisfit misfit = MisfitOf(Slid(walk, 5, 6, 9.0));
  EXPECT_FALSE(misfit.Tells());
  EXPECT_EQ(Sum(misfit), 0.0);
  EXPECT_EQ(Mean(misfit), 0.0);
}

}  // namespace
}  // namespace orbweave
