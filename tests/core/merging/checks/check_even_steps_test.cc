// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_even_steps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/merging/checks/even_drive.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

constexpr double kStep_m = EvenDrive::kStep_m;
constexpr uint32_t kImages = EvenDrive::kImages;

TEST(CheckEvenSteps, IsGoodWhereStepsAreEven) {
  const EvenDrive street;
  EXPECT_EQ(CheckEvenSteps(street.images, street.manifest).level, CheckLevel::kGood);
  EXPECT_EQ(CheckEvenSteps({}, street.manifest).level, CheckLevel::kGood);
}

TEST(CheckEvenSteps, NamesWhoStandsAWindowOff) {
  EvenDrive street;
  street.Move(17, 5.0);
  street.Move(30, -4.0);
  const CrossCheck check = CheckEvenSteps(street.images, street.manifest);
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_NEAR(check.value, 5.0 / kStep_m, 1e-9);
  EXPECT_THAT(check.sentence, HasSubstr("2 panoramas"));
  EXPECT_THAT(check.sentence, HasSubstr("17.jpg by 0.6 steps"));
}

TEST(CheckEvenSteps, CountsPlacesOfThoseThatAreLeftOut) {
  EvenDrive street;
  street.images.erase(ImageId(12));
  street.images.erase(ImageId(25));
  street.images[ImageId(26)].loose = true;
  EXPECT_EQ(CheckEvenSteps(street.images, street.manifest).level, CheckLevel::kGood);
}

TEST(CheckEvenSteps, CountsCapturesThatWereTakenOutByTheirNumbers) {
  // The one before a corner was taken out: from 16 to 17 are two steps.
  EvenDrive street;
  const Eigen::Vector3d corner(18.0 * kStep_m, 0.0, 0.0);
  const Eigen::Vector3d onward = kStep_m * Eigen::Vector3d(-0.25, 0.97, 0.0);
  for (uint32_t i = 17; i < kImages; ++i) street.Place(i, corner + (i - 17.0) * onward);
  EXPECT_EQ(CheckEvenSteps(street.images, street.manifest).level, CheckLevel::kDoubtful);
  for (uint32_t i = 17; i < kImages; ++i)
    street.manifest.images[i].name = std::to_string(i + 1) + ".jpg";
  EXPECT_EQ(CheckEvenSteps(street.images, street.manifest).level, CheckLevel::kGood);
}

TEST(CheckEvenSteps, BelievesPositions) {
  EvenDrive street;
  street.Move(17, 5.0);
  for (uint32_t i = 0; i < kImages; ++i) street.Position(i, i == 17 ? 5.0 : 0.0);
  EXPECT_EQ(CheckEvenSteps(street.images, street.manifest).level, CheckLevel::kGood);
  street.Position(17, 0.0);
  EXPECT_EQ(CheckEvenSteps(street.images, street.manifest).level, CheckLevel::kDoubtful);
}

}  // namespace
}  // namespace orbweave
