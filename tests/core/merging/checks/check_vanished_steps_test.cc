// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_vanished_steps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/merging/checks/check_even_steps.h"
#include "tests/core/merging/checks/even_drive.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

/// All from `first` on stand so much nearer.
void DrawNear(uint32_t first, double by_m, EvenDrive& drive) {
  for (uint32_t i = first; i < EvenDrive::kImages; ++i) drive.Move(i, -by_m);
}

TEST(CheckVanishedSteps, IsGoodWhereStepsAreEven) {
  const EvenDrive drive;
  EXPECT_EQ(CheckVanishedSteps(drive.images, drive.manifest).level, CheckLevel::kGood);
  EXPECT_EQ(CheckVanishedSteps({}, drive.manifest).level, CheckLevel::kGood);
}

TEST(CheckVanishedSteps, NamesAStepThatIsAHouseTooShort) {
  EvenDrive drive;
  DrawNear(17, 7.6, drive);
  const CrossCheck check = CheckVanishedSteps(drive.images, drive.manifest);
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_NEAR(check.value, 0.95, 1e-9);
  EXPECT_THAT(check.sentence, HasSubstr("from 16.jpg to 17.jpg, 5 %"));
  EXPECT_EQ(CheckEvenSteps(drive.images, drive.manifest).level, CheckLevel::kGood);
}

TEST(CheckVanishedSteps, NamesAStepThatLeadsBackUnlessPositionsDoToo) {
  EvenDrive drive;
  DrawNear(17, 17.6, drive);
  const CrossCheck check = CheckVanishedSteps(drive.images, drive.manifest);
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_NEAR(check.value, 2.2, 1e-9);
  EXPECT_THAT(check.sentence, HasSubstr("from 16.jpg to 17.jpg, 120 % back"));
  for (uint32_t i = 0; i < EvenDrive::kImages; ++i) drive.Position(i, i < 17 ? 0.0 : -17.6);
  EXPECT_EQ(CheckVanishedSteps(drive.images, drive.manifest).level, CheckLevel::kGood);
  for (uint32_t i = 17; i < EvenDrive::kImages; ++i) drive.Position(i, 0.0);
  EXPECT_EQ(CheckVanishedSteps(drive.images, drive.manifest).level, CheckLevel::kDoubtful);
}

TEST(CheckVanishedSteps, LeavesAFrameTwiceAndACameraThatSlowsDownAlone) {
  EvenDrive twice;
  DrawNear(17, 7.9, twice);
  EXPECT_EQ(CheckVanishedSteps(twice.images, twice.manifest).level, CheckLevel::kGood);
  EvenDrive slow;
  DrawNear(16, 4.0, slow);
  DrawNear(17, 11.6, slow);
  EXPECT_EQ(CheckVanishedSteps(slow.images, slow.manifest).level, CheckLevel::kGood);
}

TEST(CheckVanishedSteps, BelievesPositions) {
  EvenDrive drive;
  DrawNear(17, 7.6, drive);
  for (uint32_t i = 0; i < EvenDrive::kImages; ++i) drive.Position(i, i < 17 ? 0.0 : -7.6);
  EXPECT_EQ(CheckVanishedSteps(drive.images, drive.manifest).level, CheckLevel::kGood);
  for (uint32_t i = 17; i < EvenDrive::kImages; ++i) drive.Position(i, 0.0);
  EXPECT_EQ(CheckVanishedSteps(drive.images, drive.manifest).level, CheckLevel::kDoubtful);
}

TEST(CheckVanishedSteps, AsksPositionsAtAnEnd) {
  for (const uint32_t end : {0U, EvenDrive::kImages - 1}) {
    EvenDrive drive;
    const double nearer_m = end == 0 ? 6.8 : -6.8;
    drive.Move(end, nearer_m);
    EXPECT_EQ(CheckVanishedSteps(drive.images, drive.manifest).level, CheckLevel::kGood)
        << "it may have started there";
    for (uint32_t i = 0; i < EvenDrive::kImages; ++i) drive.Position(i, 0.0);
    const CrossCheck check = CheckVanishedSteps(drive.images, drive.manifest);
    EXPECT_EQ(check.level, CheckLevel::kDoubtful);
    EXPECT_NEAR(check.value, 0.85, 1e-9);
    const std::vector<ShortStep> found = FindShortSteps(drive.images, drive.manifest);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].end, ImageId(end));
    drive.Position(end, nearer_m);
    EXPECT_EQ(CheckVanishedSteps(drive.images, drive.manifest).level, CheckLevel::kGood);
    drive.Position(end, 0.0);
    for (ImageRecord& image : drive.manifest.images) image.prior.horizontal_sigma_m = 3.0;
    EXPECT_EQ(CheckVanishedSteps(drive.images, drive.manifest).level, CheckLevel::kGood)
        << "positions do not know";
  }
}

}  // namespace
}  // namespace orbweave
