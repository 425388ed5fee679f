// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_drive_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

/// Images 8 m and a second apart; times off by `jitter_s` and rounded to `resolution_s`.
struct Drive {
  explicit Drive(double jitter_s = 0.0, double resolution_s = 0.0) {
    Random random(4);
    for (uint32_t i = 0; i < 40; ++i) {
      ImageRecord& record = manifest.images.emplace_back();
      record.id = ImageId(i);
      record.name = "pano_" + std::to_string(i);
      double time_s = i + jitter_s * random.Normal();
      if (resolution_s > 0.0) time_s = resolution_s * std::floor(time_s / resolution_s);
      record.capture_time_s = time_s;
      images[record.id].cam_from_world =
          Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {8.0 * i, 0.0, 0.0});
    }
  }
  void Move(uint32_t image, const Eigen::Vector3d& by) {
    Rigid3& pose = images.at(ImageId(image)).cam_from_world;
    pose = Rigid3::FromCentre(pose.rotation, pose.Centre() + by);
  }
  [[nodiscard]] CrossCheck Check() const { return CheckDriveMotion(images, manifest); }

  ImageManifest manifest{};
  std::map<ImageId, RegisteredImage> images{};
};

TEST(CheckDriveMotion, NamesThePanoramaAHouseTooFarAlong) {
  Drive drive;
  drive.Move(20, {11.0, 0.0, 0.0});
  const CrossCheck check = drive.Check();
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_NEAR(check.value, 11.0, 1e-6);
  EXPECT_THAT(check.sentence, HasSubstr("1 of 38 panoramas"));
  EXPECT_THAT(check.sentence, HasSubstr("pano_20 by 11.0 m"));
  EXPECT_THAT(check.sentence, HasSubstr("reached at 19.0 and left at 3.0 m/s"));
}

TEST(CheckDriveMotion, AsksTheOthersWhereATimeIsMissing) {
  Drive drive;
  drive.Move(20, {11.0, 0.0, 0.0});
  drive.manifest.images[5].capture_time_s.reset();
  const CrossCheck check = drive.Check();
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_THAT(check.sentence, HasSubstr("1 of 37 panoramas"));
}

TEST(CheckDriveMotion, FindsAStretchThatStandsAHouseTooFar) {
  Drive drive;
  for (uint32_t i = 20; i < 40; ++i) drive.Move(i, {-14.0, 0.0, 0.0});
  EXPECT_EQ(drive.Check().level, CheckLevel::kDoubtful);
}

TEST(CheckDriveMotion, BelievesWhatCarsDo) {
  EXPECT_EQ(Drive().Check().level, CheckLevel::kGood);
  Drive corner;  // a turn of a quarter within two seconds
  for (uint32_t i = 20; i < 40; ++i) corner.Move(i, {-8.0 * (i - 20.0), 8.0 * (i - 20.0), 0.0});
  EXPECT_EQ(corner.Check().level, CheckLevel::kGood);
  Drive stop;
  for (uint32_t i = 20; i < 40; ++i) stop.Move(i, {-8.0 * (i - 20.0), 0.0, 0.0});
  EXPECT_EQ(stop.Check().level, CheckLevel::kGood);
}

TEST(CheckDriveMotion, TimesThatAreOffAreNotTheModels) {
  EXPECT_EQ(Drive(0.15).Check().level, CheckLevel::kGood);
  EXPECT_EQ(Drive(0.3, 1.0).Check().level, CheckLevel::kGood);
  Drive confirmed;
  for (ImageRecord& image : confirmed.manifest.images) {
    image.prior.position_in_enu = confirmed.images.at(image.id).cam_from_world.Centre();
  }
  confirmed.Move(20, {11.0, 0.0, 0.0});
  EXPECT_EQ(confirmed.Check().level, CheckLevel::kDoubtful);
  *confirmed.manifest.images[20].prior.position_in_enu += Eigen::Vector3d(9.0, 1.0, 0.0);
  EXPECT_EQ(confirmed.Check().level, CheckLevel::kGood);
}

TEST(CheckDriveMotion, AsksNothingWithoutTimesOrOfLooseImages) {
  Drive drive;
  drive.Move(20, {30.0, 0.0, 0.0});
  drive.images.at(ImageId(20)).loose = true;
  EXPECT_EQ(drive.Check().level, CheckLevel::kGood);
  drive.images.at(ImageId(20)).loose = false;
  for (ImageRecord& image : drive.manifest.images) image.capture_time_s.reset();
  EXPECT_EQ(drive.Check().level, CheckLevel::kGood);
  EXPECT_THAT(drive.Check().sentence, HasSubstr("no five panoramas"));
  EXPECT_EQ(CheckDriveMotion({}, {}).level, CheckLevel::kGood);
}

}  // namespace
}  // namespace orbweave
