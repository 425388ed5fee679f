// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_leans.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/core/merging/driven_street.h"

namespace orbweave {
namespace {

using testing::AddDrive;
using testing::Drive;
using testing::DrivenStreet;
using ::testing::HasSubstr;

constexpr double kRadPerDeg = EIGEN_PI / 180.0;
const testing::DriveOptions kSwaying{.turn_rad = 1.6, .sway_rad = 0.02};

CrossCheck Check(DrivenStreet& street) {
  for (ImageRecord& image : street.manifest.images)
    image.name = "pano_" + std::to_string(image.id.value);
  return CheckLeans(street.model.images, street.manifest);
}

/// What comes after `first` leans to the side by as many degrees more, panorama by panorama.
void Bend(DrivenStreet& street, uint32_t first, double step_deg) {
  for (auto& [id, image] : street.model.images) {
    if (id.value <= first) continue;
    const double lean_rad = kRadPerDeg * step_deg * (id.value - first);
    Rigid3& pose = image.cam_from_world;
    pose =
        Rigid3::FromCentre(RotationFromVector({0.0, 0.0, lean_rad}) * pose.rotation, pose.Centre());
  }
}

TEST(CheckLeans, FindsNothingInAnUprightStreet) {
  DrivenStreet street = Drive(kSwaying, 1);
  const CrossCheck check = Check(street);
  EXPECT_EQ(check.level, CheckLevel::kGood);
  EXPECT_TRUE(check.IsWithinLimit());
  EXPECT_THAT(check.sentence, HasSubstr("in the median"));
}

TEST(CheckLeans, TakesTheMountOfADriveForUpright) {
  Random random(2);
  DrivenStreet street;
  AddDrive({.turn_rad = 1.6, .mount = RotationFromVector({0.2, 0.0, 0.0}), .sway_rad = 0.02},
           random,
           street);
  AddDrive(kSwaying, random, street);
  EXPECT_EQ(Check(street).level, CheckLevel::kGood);
}

TEST(CheckLeans, NamesWhereAStreetIsBent) {
  DrivenStreet street = Drive(kSwaying, 3);
  Bend(street, 44, 1.2);
  const CrossCheck check = Check(street);
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_FALSE(check.IsWithinLimit());
  EXPECT_THAT(check.sentence, HasSubstr("most of all pano_5"));
}

TEST(CheckLeans, LetsAHillPass) {
  DrivenStreet street = Drive({.turn_rad = 0.2, .sway_rad = 0.01}, 4);
  for (uint32_t i = 30; i < 60; ++i) {  // six degrees
    Rigid3& pose = street.model.images.at(ImageId(i)).cam_from_world;
    pose = Rigid3::FromCentre(RotationFromVector({6.0 * kRadPerDeg, 0.0, 0.0}) * pose.rotation,
                              pose.Centre());
  }
  EXPECT_EQ(Check(street).level, CheckLevel::kGood);
}

TEST(CheckLeans, DoesNotJudgeWhatIsHeldByHand) {
  DrivenStreet street = Drive({.turn_rad = 1.6, .sway_rad = 0.15}, 5);
  const CrossCheck check = Check(street);
  EXPECT_EQ(check.level, CheckLevel::kGood);
  EXPECT_THAT(check.sentence, HasSubstr("tells nothing"));
}

}  // namespace
}  // namespace orbweave
