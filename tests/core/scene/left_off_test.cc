// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/left_off.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Positions along a street, 2 m well known each.
std::vector<PosePrior> At(const std::vector<double>& metres_east) {
  std::vector<PosePrior> priors;
  for (const double east : metres_east) {
    priors.push_back({.position_in_enu = Eigen::Vector3d(east, 0.0, 0.0)});
    priors.back().horizontal_sigma_m = 2.0;
  }
  return priors;
}

std::vector<uint8_t> LeftOff(const std::vector<PosePrior>& priors) {
  std::vector<const PosePrior*> sequence;
  for (const PosePrior& prior : priors) sequence.push_back(&prior);
  return LeftOffBehind(sequence);
}

TEST(LeftOffBehind, IsWhereAStretchIsMissing) {
  EXPECT_THAT(LeftOff(At({0, 8, 16, 24, 70, 78, 86})), ElementsAre(0, 0, 0, 1, 0, 0, 0));
}

TEST(LeftOffBehind, ALongerStepIsNone) {
  EXPECT_THAT(LeftOff(At({0, 8, 16, 24, 56, 64, 72})), Each(0));  // of 3 x 8 m + 3 x 2.8 m
}

TEST(LeftOffBehind, OnePositionThatIsOffIsNone) {
  EXPECT_THAT(LeftOff(At({0, 8, 16, 124, 32, 40, 48})), Each(0));
}

TEST(LeftOffBehind, AShorterStretchBetweenTwoGapsIsOneOfItsOwn) {
  EXPECT_THAT(LeftOff(At({0, 8, 16, 70, 78, 140, 148, 156})), ElementsAre(0, 0, 1, 0, 1, 0, 0, 0));
}

TEST(LeftOffBehind, AnImageWithoutAPositionNearTheGapHidesNothing) {
  std::vector<PosePrior> priors = At({0, 8, 16, 24, 70, 78, 86});
  priors[5].position_in_enu.reset();
  EXPECT_THAT(LeftOff(priors), ElementsAre(0, 0, 0, 1, 0, 0, 0));
  priors[2].position_in_enu.reset();
  EXPECT_THAT(LeftOff(priors), ElementsAre(0, 0, 0, 1, 0, 0, 0));
  priors[3].position_in_enu.reset();
  EXPECT_THAT(LeftOff(priors), Each(0)) << "nothing tells behind which of them";
}

TEST(LeftOffBehind, IsNotToldOfACameraThatStoodMostOfTheTime) {
  EXPECT_THAT(LeftOff(At({0, 0.5, 1, 0.5, 0, 0.2, 0.7, 8, 16, 24})), Each(0));
}

TEST(LeftOffBehind, HeightsSayNothing) {
  std::vector<PosePrior> priors = At({0, 8, 16, 24, 32});
  priors[3].position_in_enu->z() = priors[4].position_in_enu->z() = 500.0;
  EXPECT_THAT(LeftOff(priors), Each(0));
}

/// Images of one drive at these places along a street, and at these times, if any.
std::vector<uint8_t> LeftOffOfDrive(const std::vector<double>& metres_east,
                                    const std::vector<double>& seconds) {
  ImageManifest manifest;
  std::vector<ImageId> sequence;
  for (const PosePrior& prior : At(metres_east)) {
    const ImageId id(static_cast<uint32_t>(sequence.size()));
    sequence.push_back(id);
    manifest.images.push_back({.id = id, .prior = prior});
    if (!seconds.empty()) manifest.images.back().capture_time_s = seconds[id.value];
  }
  return LeftOffBehind(manifest, sequence);
}

TEST(LeftOffBehind, APauseBearsOutAGapThatOnePositionMakesShorter) {
  const std::vector<double> metres = {0, 8, 16, 24, 50, 62, 70};  // the fifth truly at 54
  const std::vector<double> seconds = {0, 1, 2, 3, 10, 11, 12};
  EXPECT_THAT(LeftOffOfDrive(metres, seconds), ElementsAre(0, 0, 0, 1, 0, 0, 0));
  EXPECT_THAT(LeftOffOfDrive(metres, {}), Each(0));
  EXPECT_THAT(LeftOffOfDrive(metres, {0, 1, 2, 3, 4, 5, 6}), Each(0));
}

TEST(LeftOffBehind, ACameraThatPausedWhereItStoodIsNoGap) {
  EXPECT_THAT(LeftOffOfDrive({0, 8, 16, 24, 36, 44, 52}, {0, 1, 2, 3, 60, 61, 62}), Each(0));
}

TEST(LeftOffBehind, IsNotToldWithoutPositions) {
  std::vector<PosePrior> priors = At({0, 8, 16, 124, 132, 140});
  for (PosePrior& prior : priors) prior.position_in_enu.reset();
  EXPECT_THAT(LeftOff(priors), Each(0));
  EXPECT_THAT(LeftOff({}), IsEmpty());
  EXPECT_THAT(LeftOff(At({5})), ElementsAre(0));
}

}  // namespace
}  // namespace orbweave
