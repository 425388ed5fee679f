// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_attitudes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "core/merging/georeference/drive_attitudes.h"
#include "tests/core/merging/driven_street.h"

namespace orbweave {
namespace {

using testing::AddDrive;
using testing::Drive;
using testing::DrivenStreet;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kDegPerRad = 180.0 / EIGEN_PI;
const Eigen::Quaterniond kPitched = RotationFromVector({0.2, 0.0, 0.0});
const testing::DriveOptions kSwaying{.turn_rad = 1.6, .sway_rad = 0.03};

/// States the true pitch and roll of every panorama, to 1 degree, after `change`.
void State(DrivenStreet& street, const std::function<void(PosePrior&)>& change = {}) {
  for (ImageRecord& image : street.manifest.images) {
    image.name = "pano_" + std::to_string(image.id.value);
    const Eigen::Vector3d down =
        street.model.images.at(image.id).cam_from_world.rotation * -Eigen::Vector3d::UnitZ();
    image.prior.pitch_deg = -kDegPerRad * std::asin(down.z());
    image.prior.roll_deg = kDegPerRad * std::atan2(down.x(), down.y());
    image.prior.tilt_sigma_deg = 1.0;
    if (change) change(image.prior);
  }
}

CrossCheck Check(const DrivenStreet& street, const std::string& name) {
  for (CrossCheck& check : CheckAttitudes(street.model.images, street.manifest)) {
    if (check.name == name) return std::move(check);
  }
  return {};
}

TEST(CheckAttitudes, SaysHowTheMountOfEachDriveLeans) {
  Random random(5);
  DrivenStreet street;
  AddDrive({.turn_rad = 1.5, .mount = kPitched, .sway_rad = 0.01}, random, street);
  AddDrive({.turn_rad = 1.5, .sway_rad = 0.01}, random, street);
  street.manifest.images[0].name = "first";
  street.manifest.images[60].name = "second";
  const CrossCheck check = Check(street, "drive_mounts");
  EXPECT_EQ(check.level, CheckLevel::kGood);
  EXPECT_NEAR(check.value, 0.2 * kDegPerRad, 0.5);
  EXPECT_THAT(check.sentence, HasSubstr("11.4 deg (sigma "));
  EXPECT_THAT(check.sentence, HasSubstr("in the drive of first, 0."));
  EXPECT_THAT(check.sentence, HasSubstr("in the drive of second"));
  EXPECT_EQ(Check(street, "stated_attitude").name, "") << "nobody states anything";
}

TEST(CheckAttitudes, BelievesWhatAgrees) {
  DrivenStreet street = Drive(kSwaying, 1);
  State(street);
  EXPECT_EQ(Check(street, "stated_attitude").level, CheckLevel::kGood);
  EXPECT_LT(Check(street, "stated_attitude").value, 0.1);
  EXPECT_THAT(Check(street, "stated_attitude").sentence, HasSubstr("60 panoramas state agree"));
  Random random(3);
  State(street, [&](PosePrior& prior) {
    *prior.pitch_deg += random.Normal();
    *prior.roll_deg += random.Normal();
  });
  EXPECT_EQ(Check(street, "stated_attitude").level, CheckLevel::kGood);
}

TEST(CheckAttitudes, DoesNotTakeNoiseForTheOtherSign) {
  DrivenStreet street = Drive({.turn_rad = 1.6, .sway_rad = 0.005}, 1);
  Random random(3);
  State(street, [&](PosePrior& prior) {
    *prior.pitch_deg = 3.0 * random.Normal();
    *prior.roll_deg = 3.0 * random.Normal();
    prior.tilt_sigma_deg = 3.0;
  });
  EXPECT_EQ(Check(street, "stated_attitude").level, CheckLevel::kGood);
}

TEST(CheckAttitudes, NamesTheAngleWithTheWrongSign) {
  DrivenStreet street = Drive(kSwaying, 1);
  State(street, [](PosePrior& prior) { *prior.pitch_deg *= -1.0; });
  CrossCheck check = Check(street, "stated_attitude");
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_GT(check.value, check.limit);
  EXPECT_THAT(check.sentence, HasSubstr("the pitch that the drive of pano_0 states fits"));
  State(street, [](PosePrior& prior) { *prior.roll_deg *= -1.0; });
  check = Check(street, "stated_attitude");
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_THAT(check.sentence, HasSubstr("the roll that"));
}

TEST(CheckAttitudes, SeesTheWrongSignOfAnAngleThatStaysTheSame) {
  DrivenStreet street = Drive({.turn_rad = 1.6, .mount = kPitched, .sway_rad = 0.005}, 1);
  State(street);
  EXPECT_EQ(Check(street, "stated_attitude").level, CheckLevel::kGood);
  State(street, [](PosePrior& prior) { *prior.pitch_deg *= -1.0; });
  const CrossCheck check = Check(street, "stated_attitude");
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_THAT(check.sentence, HasSubstr("the pitch that"));
}

TEST(CheckAttitudes, SeesAnglesThatAreWorseThanStatedOrAllOff) {
  DrivenStreet street = Drive(kSwaying, 1);
  Random random(3);
  State(street, [&](PosePrior& prior) { *prior.roll_deg += 10.0 * random.Normal(); });
  EXPECT_THAT(Check(street, "stated_attitude").sentence, HasSubstr("deg in the median"));
  EXPECT_EQ(Check(street, "stated_attitude").level, CheckLevel::kDoubtful);
  State(street, [&](PosePrior& prior) { *prior.roll_deg += 12.0; });
  EXPECT_THAT(Check(street, "stated_attitude").sentence, HasSubstr("all alike"));
  EXPECT_EQ(Check(street, "stated_attitude").level, CheckLevel::kDoubtful);
}

TEST(CheckAttitudes, SaysWhoseAnglesAreNotUsedAndWhy) {
  DrivenStreet street = Drive(kSwaying, 1);
  State(street, [i = 0](PosePrior& prior) mutable {
    if (i++ % 3 != 0) prior.roll_deg.reset();
  });
  const CrossCheck check = Check(street, "stated_attitude");
  EXPECT_EQ(check.level, CheckLevel::kGood);
  EXPECT_THAT(check.sentence,
              HasSubstr("not used where fewer than half of a drive state both pitch and roll: 20 "
                        "of 60 panoramas of the drive of pano_0 do"));
  State(street);
  EXPECT_THAT(Check(street, "stated_attitude").sentence, Not(HasSubstr("not used")));
}

TEST(CheckAttitudes, IsSilentAboutNothing) { EXPECT_TRUE(CheckAttitudes({}, {}).empty()); }

}  // namespace
}  // namespace orbweave
