// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_sequence_steps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

struct Drive {
  ImageManifest manifest{};
  std::map<ImageId, RegisteredImage> images{};

  [[nodiscard]] CrossCheck Check(bool georeferenced = false) const {
    return CheckSequenceSteps(images, manifest, georeferenced);
  }
  void Move(uint32_t image, const Eigen::Vector3d& by) {
    Rigid3& pose = images.at(ImageId(image)).cam_from_world;
    pose = Rigid3::FromCentre(pose.rotation, pose.Centre() + by);
  }
};

Drive DriveAlong(const std::vector<Eigen::Vector3d>& centres, double gnss_sigma_m = 0.0) {
  Drive drive;
  Random random(1);
  for (uint32_t i = 0; i < centres.size(); ++i) {
    ImageRecord& record = drive.manifest.images.emplace_back();
    record.id = ImageId(i);
    record.name = "pano_" + std::to_string(i);
    drive.images[record.id].cam_from_world =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), centres[i]);
    if (gnss_sigma_m == 0.0) continue;
    const Eigen::Vector3d noise(random.Normal(), random.Normal(), random.Normal());
    record.prior.position_in_enu = centres[i] + gnss_sigma_m * noise;
  }
  return drive;
}

/// From (0, 0) on, each step of `steps_m` in a direction turned from the last one by `turns_deg`.
std::vector<Eigen::Vector3d> Way(const std::vector<double>& steps_m,
                                 const std::map<size_t, double>& turns_deg = {}) {
  std::vector<Eigen::Vector3d> way = {Eigen::Vector3d::Zero()};
  double heading = 0.0;
  for (size_t i = 0; i < steps_m.size(); ++i) {
    if (const auto turn = turns_deg.find(i); turn != turns_deg.end())
      heading += turn->second / 57.29577951308232;
    way.push_back(way.back() +
                  steps_m[i] * Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.0));
  }
  return way;
}

TEST(CheckSequenceSteps, FindsAPanoramaElevenMetresOff) {
  Drive drive = DriveAlong(Way(std::vector<double>(40, 3.0)));
  drive.Move(20, {11.0, 0.0, 0.0});  // steps of 3, 3, 14, 8, 3
  const CrossCheck check = drive.Check();
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_NEAR(check.value, 11.0, 1e-9);
  EXPECT_THAT(check.sentence, HasSubstr("pano_20 by 11.0"));
  EXPECT_THAT(check.sentence, HasSubstr("1 of 39"));
}

TEST(CheckSequenceSteps, FindsItBesideTheStreetAndAboveIt) {
  for (const Eigen::Vector3d& by : {Eigen::Vector3d(0, 11, 0), Eigen::Vector3d(0, 0, 11)}) {
    Drive drive = DriveAlong(Way(std::vector<double>(40, 3.0)));
    drive.Move(20, by);
    EXPECT_EQ(drive.Check().level, CheckLevel::kDoubtful);
  }
}

TEST(CheckSequenceSteps, DoesNotDoubtStopsTurnsAndIrregularSteps) {
  EXPECT_EQ(DriveAlong(Way(std::vector<double>(40, 3.0))).Check().level, CheckLevel::kGood);
  std::vector<double> stop(40, 3.0);
  for (size_t i = 15; i < 25; ++i) stop[i] = 0.001;
  EXPECT_EQ(DriveAlong(Way(stop)).Check().level, CheckLevel::kGood);
  EXPECT_EQ(DriveAlong(Way(std::vector<double>(40, 3.0), {{20, 90.0}})).Check().level,
            CheckLevel::kGood);
  EXPECT_EQ(DriveAlong(Way(std::vector<double>(40, 3.0), {{20, 180.0}})).Check().level,
            CheckLevel::kGood);
  std::vector<double> gap(40, 3.0);
  gap[20] = 60.0;
  EXPECT_EQ(DriveAlong(Way(gap)).Check().level, CheckLevel::kGood);
  Random random(5);
  std::vector<double> irregular;
  for (int i = 0; i < 200; ++i) irregular.push_back(random.Uniform(1.0, 12.0));
  EXPECT_EQ(DriveAlong(Way(irregular)).Check().level, CheckLevel::kGood);
}

TEST(CheckSequenceSteps, TremblingAtAStopIsNoWay) {
  std::vector<Eigen::Vector3d> way = Way(std::vector<double>(20, 3.0));
  Random random(2);
  for (int i = 0; i < 60; ++i) {
    way.push_back(Eigen::Vector3d(60.0, 0.0, 0.0) +
                  0.002 * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()));
  }
  for (const Eigen::Vector3d& centre : Way(std::vector<double>(20, 3.0)))
    way.push_back(centre + Eigen::Vector3d(60.0, 0.0, 0.0));
  EXPECT_EQ(DriveAlong(way).Check().level, CheckLevel::kGood);
}

TEST(CheckSequenceSteps, GnssConfirmsADetourThatWasDriven) {
  std::vector<Eigen::Vector3d> way = Way(std::vector<double>(40, 3.0));
  way[20] += Eigen::Vector3d(0.0, 15.0, 0.0);
  EXPECT_EQ(DriveAlong(way).Check().level, CheckLevel::kDoubtful);
  EXPECT_EQ(DriveAlong(way, 1.0).Check(true).level, CheckLevel::kGood);
}

TEST(CheckSequenceSteps, GnssFindsADisplacementOfLessThanADetour) {
  Drive drive = DriveAlong(Way(std::vector<double>(40, 8.0)), 0.5);
  drive.Move(20, {0.0, 9.0, 0.0});
  EXPECT_EQ(drive.Check(false).level, CheckLevel::kGood);
  const CrossCheck check = drive.Check(true);
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_EQ(check.unit, "m");
  EXPECT_NEAR(check.value, 9.0, 2.0);
}

TEST(CheckSequenceSteps, AJumpOfGnssIsNotTheModels) {
  Drive drive = DriveAlong(Way(std::vector<double>(40, 3.0)), 0.5);
  for (uint32_t i = 15; i < 25; ++i)
    *drive.manifest.images[i].prior.position_in_enu += Eigen::Vector3d(100.0, 0.0, 0.0);
  EXPECT_EQ(drive.Check(true).level, CheckLevel::kGood);
}

TEST(CheckSequenceSteps, AJumpOfGnssWhereADriveLeftOffIsNotTheModels) {
  // Round a corner while another day went on, and the last position before it is off.
  std::vector<double> steps(30, 3.0);
  steps[14] = 29.0;
  Drive drive = DriveAlong(Way(steps, {{14, 50.0}}), 0.3);
  *drive.manifest.images[14].prior.position_in_enu += Eigen::Vector3d(11.0, 6.0, 0.0);
  EXPECT_EQ(drive.Check(true).level, CheckLevel::kGood) << drive.Check(true).sentence;
}

TEST(CheckSequenceSteps, ImagesBesideAPauseInWhichTheDriveWentOnElsewhereAreNoNeighbours) {
  std::vector<double> steps(30, 3.0);
  steps[14] = 29.0;
  Drive drive = DriveAlong(Way(steps), 0.3);
  // Behind the gap a position lies closer to what is before it.
  *drive.manifest.images[15].prior.position_in_enu -= Eigen::Vector3d(18.0, 0.0, 0.0);
  EXPECT_EQ(drive.Check(true).level, CheckLevel::kDoubtful);
  for (uint32_t i = 0; i < drive.manifest.images.size(); ++i)
    drive.manifest.images[i].capture_time_s = i < 15 ? i : i + 9.0;
  EXPECT_EQ(drive.Check(true).level, CheckLevel::kGood) << drive.Check(true).sentence;
}

TEST(CheckSequenceSteps, ManyDisplacedPanoramasAreBad) {
  Drive drive = DriveAlong(Way(std::vector<double>(60, 3.0)));
  for (const uint32_t i : {10U, 20U, 30U, 40U}) drive.Move(i, {0.0, 12.0, 0.0});
  EXPECT_EQ(drive.Check().level, CheckLevel::kBad);
  EXPECT_THAT(drive.Check().sentence, HasSubstr("4 of 59"));
}

TEST(CheckSequenceSteps, GoesByCaptureTimesWhereAllAreKnown) {
  std::vector<Eigen::Vector3d> way = Way(std::vector<double>(40, 3.0));
  std::swap(way[10], way[30]);
  Drive drive = DriveAlong(way);
  EXPECT_NE(drive.Check().level, CheckLevel::kGood);
  for (uint32_t i = 0; i < way.size(); ++i) drive.manifest.images[i].capture_time_s = i;
  std::swap(drive.manifest.images[10].capture_time_s, drive.manifest.images[30].capture_time_s);
  EXPECT_EQ(drive.Check().level, CheckLevel::kGood);
}

TEST(CheckSequenceSteps, LooseAndMissingImagesTakeNoPart) {
  Drive drive = DriveAlong(Way(std::vector<double>(40, 3.0)));
  drive.Move(20, {0.0, 15.0, 0.0});
  drive.images.at(ImageId(20)).loose = true;
  drive.images.erase(ImageId(30));
  EXPECT_EQ(drive.Check().level, CheckLevel::kGood);
  EXPECT_EQ(CheckSequenceSteps({}, {}, false).level, CheckLevel::kGood);
}

}  // namespace
}  // namespace orbweave
