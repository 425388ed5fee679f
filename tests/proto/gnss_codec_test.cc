// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What the adjustment knows of GNSS and of attitudes survives bytes, and nonsense does not.

#include <gtest/gtest.h>

#include <limits>

#include "proto/codec/inspection_codec.h"
#include "proto/codec/subproblem_codec.h"

namespace orbweave {
namespace {

std::vector<JoinedWorld> WorldWithErrors(double left_m) {
  JoinedWorld world;
  world.georeference.drive_errors = {{.drive = 7,
                                      .has_times = true,
                                      .ahead = -0.8,
                                      .left_m = left_m,
                                      .ahead_sigma = 0.1,
                                      .left_sigma_m = 0.2,
                                      .offset_m = {1.0, -2.0, 47.0}},
                                     {.drive = 9}};
  world.georeference.gnss_inflation = 12.5;
  world.georeference.checks = {
      {"gnss_datum", 47.0, 12.0, "m", CheckLevel::kDoubtful, "another datum"},
      {"share", 0.9, 0.7, "share", CheckLevel::kGood, "enough", CheckBound::kAtLeast, false}};
  return {world};
}

TEST(JoinedWorldsCodec, CarriesWhatDrivesHaveWrong) {
  const auto worlds = DecodeJoinedWorlds(EncodeJoinedWorlds(WorldWithErrors(3.0)).value());
  ASSERT_TRUE(worlds.ok()) << worlds.status();
  const Georeference& georeference = worlds->at(0).georeference;
  ASSERT_EQ(georeference.drive_errors.size(), 2U);
  const DriveErrors& errors = georeference.drive_errors[0];
  EXPECT_EQ(errors.drive, 7U);
  EXPECT_TRUE(errors.has_times);
  EXPECT_EQ(errors.ahead, -0.8);
  EXPECT_EQ(errors.left_m, 3.0);
  EXPECT_EQ(errors.ahead_sigma, 0.1);
  EXPECT_EQ(errors.left_sigma_m, 0.2);
  EXPECT_EQ(errors.offset_m, Eigen::Vector3d(1.0, -2.0, 47.0));
  EXPECT_FALSE(georeference.drive_errors[1].has_times);
  EXPECT_EQ(georeference.gnss_inflation, 12.5);
  ASSERT_EQ(georeference.checks.size(), 2U);
  EXPECT_EQ(georeference.checks[0].name, "gnss_datum");
  EXPECT_EQ(georeference.checks[0].level, CheckLevel::kDoubtful);
  EXPECT_EQ(georeference.checks[0].bound, CheckBound::kAtMost);
  EXPECT_EQ(georeference.checks[1].bound, CheckBound::kAtLeast);
  EXPECT_TRUE(georeference.checks[0].is_told);
  EXPECT_FALSE(georeference.checks[1].is_told);
}

TEST(JoinedWorldsCodec, RefusesErrorsThatAreNoNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(DecodeJoinedWorlds(EncodeJoinedWorlds(WorldWithErrors(nan)).value()).ok());
  for (const double inflation : {nan, 0.0, 0.9, std::numeric_limits<double>::infinity()}) {
    std::vector<JoinedWorld> worlds = WorldWithErrors(3.0);
    worlds[0].georeference.gnss_inflation = inflation;
    EXPECT_FALSE(DecodeJoinedWorlds(EncodeJoinedWorlds(worlds).value()).ok()) << inflation;
  }
}

TEST(SubproblemInspectionCodec, CarriesWhatPanoramasBetweenOthersSee) {
  SubproblemInspection inspection;
  inspection.seen_between = {{ImageId(2), 80, 41}, {ImageId(7), 1, 0}};
  const auto decoded = DecodeSubproblemInspection(EncodeSubproblemInspection(inspection).value());
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  ASSERT_EQ(decoded->seen_between.size(), 2U);
  EXPECT_EQ(decoded->seen_between[0].image, ImageId(2));
  EXPECT_EQ(decoded->seen_between[0].asked, 80U);
  EXPECT_EQ(decoded->seen_between[0].seen, 41U);
  inspection.seen_between[1].seen = 2;
  EXPECT_FALSE(DecodeSubproblemInspection(EncodeSubproblemInspection(inspection).value()).ok());
}

TEST(SubproblemInspectionCodec, CarriesPointsAboutPanoramas) {
  SubproblemInspection inspection;
  inspection.points_about = {{1.0, 2.0, 3.0}, {-4.0, 5.0, -6.0}};
  const auto decoded = DecodeSubproblemInspection(EncodeSubproblemInspection(inspection).value());
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_EQ(decoded->points_about, inspection.points_about);
  inspection.points_about[0].x() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(DecodeSubproblemInspection(EncodeSubproblemInspection(inspection).value()).ok());
}

Subproblem SubproblemWithDirection(ImageId of, double sigma_rad) {
  Subproblem subproblem;
  subproblem.scene.images[ImageId(2)] = {};
  subproblem.images = {{.id = ImageId(2), .camera = {64, 32}}};
  subproblem.directions = {{.image = of,
                            .direction_in_world = {0.0, 0.6, -0.8},
                            .direction_in_cam = {0.0, 0.8, 0.6},
                            .sigma_rad = sigma_rad}};
  return subproblem;
}

TEST(SubproblemCodec, CarriesDirectionsOfImagesThatItHolds) {
  const auto subproblem =
      DecodeSubproblem(EncodeSubproblem(SubproblemWithDirection(ImageId(2), 0.1)).value());
  ASSERT_TRUE(subproblem.ok()) << subproblem.status();
  ASSERT_EQ(subproblem->directions.size(), 1U);
  const SubproblemDirection& direction = subproblem->directions[0];
  EXPECT_EQ(direction.image, ImageId(2));
  EXPECT_EQ(direction.direction_in_world, Eigen::Vector3d(0.0, 0.6, -0.8));
  EXPECT_EQ(direction.direction_in_cam, Eigen::Vector3d(0.0, 0.8, 0.6));
  EXPECT_EQ(direction.sigma_rad, 0.1);
  EXPECT_FALSE(
      DecodeSubproblem(EncodeSubproblem(SubproblemWithDirection(ImageId(3), 0.1)).value()).ok());
  EXPECT_FALSE(
      DecodeSubproblem(EncodeSubproblem(SubproblemWithDirection(ImageId(2), 0.0)).value()).ok());
}

}  // namespace
}  // namespace orbweave
