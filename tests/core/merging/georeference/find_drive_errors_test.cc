// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/find_drive_errors.h"

#include <gtest/gtest.h>

#include "core/merging/georeference/drive_regression.h"
#include "core/merging/georeference/georeference.h"
#include "core/merging/georeference/georeference_reconstruction.h"
#include "core/merging/georeference/gnss_smoothness.h"
#include "core/synthetic/make_street.h"
#include "core/synthetic/realistic_street.h"
#include "tests/core/merging/driven_street.h"

namespace orbweave {
namespace {

using testing::AddDrive;
using testing::Drive;
using testing::DrivenStreet;

FoundDriveErrors Find(const DrivenStreet& street) {
  return FindDriveErrors(GnssDrivesOf(street.model, street.manifest), Sim3{});
}

// As of a clock that is late or an antenna beside the camera.
void Shift(double ahead_m, double left_m, DrivenStreet& street) {
  for (ImageRecord& image : street.manifest.images) {
    const ImageId next(std::min(image.id.value + 1, uint32_t(street.manifest.images.size()) - 1));
    const ImageId before(next.value - 1);
    const Eigen::Vector3d way = (street.model.images.at(next).cam_from_world.Centre() -
                                 street.model.images.at(before).cam_from_world.Centre())
                                    .normalized();
    *image.prior.position_in_enu +=
        ahead_m * way + left_m * Eigen::Vector3d(-way.y(), way.x(), 0.0);
  }
}

TEST(FindDriveErrors, FindsNothingInPlainNoise) {
  for (const uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    const FoundDriveErrors found =
        Find(Drive({.panoramas = 100, .turn_rad = 2.0, .sigma_m = 2.0}, seed));
    EXPECT_TRUE(found.drives.empty()) << seed;
  }
}

TEST(FindDriveErrors, FindsAShiftAlongTheWay) {
  DrivenStreet street = Drive({.panoramas = 100, .turn_rad = 2.0, .sigma_m = 1.0}, 1);
  Shift(-8.0, 0.0, street);
  const FoundDriveErrors found = Find(street);
  ASSERT_EQ(found.drives.size(), 1U);
  for (const CrossCheck& check : found.checks) EXPECT_TRUE(check.IsWithinLimit()) << check.name;
  EXPECT_NEAR(found.drives[0].ahead, -8.0, 1.5);
  EXPECT_GT(found.drives[0].ahead_sigma, 0.0);
  EXPECT_EQ(found.checks.at(0).name, "gnss_clock");
  EXPECT_EQ(found.checks.at(0).level, CheckLevel::kGood);
  EXPECT_TRUE(found.checks.at(0).IsWithinLimit()) << found.checks.at(0).limit;
}

TEST(FindDriveErrors, MeasuresAShiftInSecondsWhereTimesAreKnown) {
  DrivenStreet street = Drive({.panoramas = 100, .turn_rad = 2.0, .sigma_m = 1.0}, 2);
  for (ImageRecord& image : street.manifest.images) image.capture_time_s = 0.3 * image.id.value;
  Shift(-8.0, 0.0, street);
  const FoundDriveErrors found = Find(street);
  ASSERT_EQ(found.drives.size(), 1U);
  EXPECT_TRUE(found.drives[0].has_times);
  EXPECT_NEAR(found.drives[0].ahead, -0.8, 0.15);
}

TEST(FindDriveErrors, FindsAnAntennaBesideTheCamera) {
  DrivenStreet street = Drive({.panoramas = 100, .turn_rad = 2.0, .sigma_m = 0.5}, 3);
  Shift(0.0, 3.0, street);
  const FoundDriveErrors found = Find(street);
  ASSERT_EQ(found.drives.size(), 1U);
  EXPECT_NEAR(found.drives[0].left_m, 3.0, 0.8);
  EXPECT_EQ(found.drives[0].ahead, 0.0);
}

TEST(FindDriveErrors, SaysThatAStraightStreetHidesAShift) {
  DrivenStreet street = Drive({.panoramas = 100, .sigma_m = 1.0}, 4);
  Shift(-8.0, 0.0, street);
  const FoundDriveErrors found = Find(street);
  EXPECT_TRUE(found.drives.empty());
  ASSERT_EQ(found.checks.size(), 1U);
  EXPECT_NE(found.checks[0].sentence.find("cannot be told"), std::string::npos);
  EXPECT_FALSE(found.checks[0].is_told);
  EXPECT_EQ(found.checks[0].sentence.find("(sigma"), std::string::npos)
      << "of nothing: " << found.checks[0].sentence;
}

// Along a circle a shift is a turn about its middle, and an antenna beside the camera a change of
// scale, which are the frame's own.
TEST(FindDriveErrors, SaysThatACircleHidesAShift) {
  DrivenStreet street =
      Drive({.panoramas = 100, .turn_rad = 2.0, .turn_share = 1.0, .sigma_m = 1.0}, 5);
  Shift(-8.0, 3.0, street);
  const FoundDriveErrors found = Find(street);
  EXPECT_TRUE(found.drives.empty());
  ASSERT_EQ(found.checks.size(), 1U);
  EXPECT_NE(found.checks[0].sentence.find("cannot be told"), std::string::npos);
  EXPECT_FALSE(found.checks[0].is_told);
}

// A drive whose speed is between 2 and 14 m/s, a panorama every half second.
DrivenStreet AtVaryingSpeed(double delay_s, double sigma_m, uint64_t seed) {
  DrivenStreet street = Drive({.panoramas = 150, .sigma_m = sigma_m}, seed);
  constexpr double kEvery_s = 0.5;
  double way_m = 0.0;
  for (ImageRecord& image : street.manifest.images) {
    const double speed = 8.0 + 6.0 * std::sin(0.15 * image.id.value);
    way_m += kEvery_s * speed;
    const Eigen::Vector3d forward(std::cos(0.3), std::sin(0.3), 0.0);
    Rigid3& pose = street.model.images.at(image.id).cam_from_world;
    const Eigen::Vector3d noise = *image.prior.position_in_enu - pose.Centre();
    pose = Rigid3::FromCentre(pose.rotation, way_m * forward);
    image.prior.position_in_enu = (way_m - delay_s * speed) * forward + noise;
    image.capture_time_s = kEvery_s * image.id.value;
  }
  return street;
}

TEST(FindDriveErrors, FindsAClockByTheSpeedOnAStraightStreet) {
  for (const uint64_t seed : {1U, 2U, 3U}) {
    const FoundDriveErrors found = Find(AtVaryingSpeed(0.4, 1.0, seed));
    ASSERT_EQ(found.drives.size(), 1U) << seed;
    EXPECT_NEAR(found.drives[0].ahead, -0.4, 0.1);
    EXPECT_TRUE(Find(AtVaryingSpeed(0.0, 1.0, seed)).drives.empty()) << seed;
  }
}

// A clock that is late by nearly a step, of a carrier that started slowly, would say the same.
TEST(FindDriveErrors, BelievesNoClockThatOneMisplacedImageTells) {
  for (const uint64_t seed : {1U, 2U, 3U}) {
    DrivenStreet street = Drive({.panoramas = 40, .turn_rad = 0.0, .sigma_m = 0.3}, seed);
    Rigid3& first = street.model.images.at(ImageId(0)).cam_from_world;
    const Eigen::Vector3d next = street.model.images.at(ImageId(1)).cam_from_world.Centre();
    first = Rigid3::FromCentre(first.rotation, first.Centre() + 0.9 * (next - first.Centre()));
    const FoundDriveErrors found = Find(street);
    EXPECT_TRUE(found.drives.empty()) << seed;
    ASSERT_EQ(found.checks.size(), 1U) << seed;
    EXPECT_NE(found.checks[0].sentence.find("cannot be told"), std::string::npos);
  }
}

// As little as noise may do, and as much as matters: said, and within what is claimed.
TEST(FindDriveErrors, AllowsForWhatItHalfBelieves) {
  int allowed_for = 0;
  int believed = 0;
  for (uint64_t seed = 1; seed <= 30; ++seed) {
    const FoundDriveErrors found = Find(AtVaryingSpeed(0.4, 7.0, seed));
    for (const DriveErrors& errors : found.drives) {
      (errors.ahead == 0.0 ? allowed_for : believed) += 1;
      EXPECT_NEAR(errors.ahead, -0.4, 3.0 * errors.ahead_sigma) << seed;
      EXPECT_EQ(found.checks.at(0).level, CheckLevel::kGood);
      EXPECT_GT(found.checks.at(0).value, 0.2);
      EXPECT_NE(
          found.checks.at(0).sentence.find(errors.ahead == 0.0 ? "allow for it" : "taken off"),
          std::string::npos);
    }
  }
  EXPECT_GT(allowed_for, 2);
  EXPECT_LT(believed, 15);
}

TEST(FindDriveErrors, DoubtsNoPlainNoise) {
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    for (const double turn_rad : {0.0, 0.5, 2.0}) {
      const FoundDriveErrors found =
          Find(Drive({.panoramas = 80, .turn_rad = turn_rad, .sigma_m = 3.0}, seed));
      EXPECT_TRUE(found.drives.empty()) << seed;
      for (const CrossCheck& check : found.checks)
        EXPECT_EQ(check.level, CheckLevel::kGood) << seed << " " << check.sentence;
    }
  }
}

TEST(FindDriveErrors, TakesOffWhatItFound) {
  DrivenStreet street = Drive({.panoramas = 100, .turn_rad = 2.0, .sigma_m = 1.0}, 1);
  Shift(-8.0, 0.0, street);
  const Georeference georeference =
      GeoreferenceReconstruction(street.model, street.manifest, GnssUse::kAuto, {}).value();
  ASSERT_TRUE(georeference.enu_from_world.has_value());
  EXPECT_LT(georeference.enu_from_world->translation.norm(), 2.0);
}

// Three drives the same way; drive `odd` has heights over another datum.
DrivenStreet ThreeDrives(uint32_t odd, uint32_t num_drives) {
  Random random(9);
  DrivenStreet street;
  for (uint32_t drive = 0; drive < num_drives; ++drive)
    AddDrive({.turn_rad = 1.0, .sigma_m = 1.0}, random, street);
  for (ImageRecord& image : street.manifest.images) {
    if (image.drive == odd) image.prior.position_in_enu->z() += 47.0;
  }
  return street;
}

TEST(FindDriveErrors, MovesTheOddDriveToTheDatumOfTheOthers) {
  for (const uint32_t odd : {0U, 1U, 2U}) {
    const DrivenStreet street = ThreeDrives(odd, 3);
    const Georeference georeference =
        GeoreferenceReconstruction(street.model, street.manifest, GnssUse::kAuto, {}).value();
    ASSERT_TRUE(georeference.enu_from_world.has_value());
    EXPECT_LT(std::abs(georeference.enu_from_world->translation.z()), 1.0);
    ASSERT_EQ(georeference.drive_errors.size(), 1U);
    EXPECT_EQ(georeference.drive_errors[0].drive, odd);
    EXPECT_NEAR(georeference.drive_errors[0].offset_m.z(), 47.0, 1.0);
    ASSERT_FALSE(georeference.checks.empty());
    EXPECT_EQ(georeference.checks.back().name, "gnss_datum");
    EXPECT_EQ(georeference.checks.back().level, CheckLevel::kGood);
    EXPECT_TRUE(georeference.checks.back().IsWithinLimit());
  }
}

TEST(FindDriveErrors, FindsNoDatumWhereHeightsAreUnknown) {
  DrivenStreet street = ThreeDrives(1, 3);
  for (ImageRecord& image : street.manifest.images) {
    if (image.drive == 1) image.prior.vertical_sigma_m = kUnknownHeightSigma_m;
  }
  const Georeference georeference =
      GeoreferenceReconstruction(street.model, street.manifest, GnssUse::kAuto, {}).value();
  ASSERT_TRUE(georeference.enu_from_world.has_value());
  EXPECT_LT(std::abs(georeference.enu_from_world->translation.z()), 1.0);
  EXPECT_TRUE(georeference.drive_errors.empty());
}

TEST(FindDriveErrors, CannotTellWhichOfTwoDatumsIsRight) {
  const DrivenStreet street = ThreeDrives(1, 2);
  const Georeference georeference =
      GeoreferenceReconstruction(street.model, street.manifest, GnssUse::kAuto, {}).value();
  ASSERT_TRUE(georeference.enu_from_world.has_value());
  EXPECT_LT(std::abs(georeference.enu_from_world->translation.z()), 1.0);  // the first one's
  EXPECT_EQ(georeference.checks.back().level, CheckLevel::kDoubtful);
  EXPECT_FALSE(georeference.checks.back().IsWithinLimit());
}

// Leaning over would bring two drives side by side to heights that are far apart.
TEST(FindDriveErrors, KeepsAStreetUprightBetweenTwoDatums) {
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    DrivenStreet street;
    for (int drive = 0; drive < 2; ++drive)
      AddDrive({.panoramas = 50, .sigma_m = 2.0, .sway_rad = 0.01}, random, street);
    const Eigen::Vector3d beside(-2.0 * std::sin(0.3), 2.0 * std::cos(0.3), 0.0);
    for (ImageRecord& image : street.manifest.images) {
      Eigen::Vector3d& position = *image.prior.position_in_enu;
      position.z() += 3.5 * random.Normal();
      image.prior.vertical_sigma_m = 4.0;
      if (image.drive == 0) continue;
      Rigid3& pose = street.model.images.at(image.id).cam_from_world;
      pose = Rigid3::FromCentre(pose.rotation, pose.Centre() + beside);
      position += beside + 15.0 * Eigen::Vector3d::UnitZ();
    }
    const Georeference georeference =
        GeoreferenceReconstruction(street.model, street.manifest, GnssUse::kAuto, {}).value();
    ASSERT_TRUE(georeference.enu_from_world.has_value());
    EXPECT_LT(RotationAngle(georeference.enu_from_world->rotation), 0.1) << seed;
  }
}

TEST(FindDriveErrors, NamesAFewPositionsOverAnotherDatum) {
  Random random(11);
  DrivenStreet street;
  AddDrive({.turn_rad = 1.0, .sigma_m = 2.0}, random, street);
  AddDrive({.panoramas = 6, .sigma_m = 2.0}, random, street);
  for (ImageRecord& image : street.manifest.images) {
    if (image.drive == 1) image.prior.position_in_enu->z() -= 40.0;
  }
  const Georeference georeference =
      GeoreferenceReconstruction(street.model, street.manifest, GnssUse::kAuto, {}).value();
  ASSERT_TRUE(georeference.enu_from_world.has_value());
  EXPECT_LT(std::abs(georeference.enu_from_world->translation.z()), 1.5);
  ASSERT_FALSE(georeference.checks.empty());
  EXPECT_EQ(georeference.checks.back().name, "gnss_datum");
  EXPECT_NEAR(georeference.checks.back().value, 40.0, 3.0);
}

TEST(MeasureGnssSmoothness, FindsTheNoiseWhateverTheSteps) {
  for (const double step_m : {0.5, 3.0, 12.0}) {
    const DrivenStreet street =
        Drive({.panoramas = 400, .step_m = step_m, .turn_rad = 1.0, .sigma_m = 2.0}, 6);
    const GnssSmoothness smoothness =
        MeasureGnssSmoothness(GnssDrivesOf(street.model, street.manifest));
    ASSERT_TRUE(smoothness.is_known);
    EXPECT_GT(smoothness.noise_m, 1.0) << step_m;
    EXPECT_LT(smoothness.noise_m, 3.0) << step_m;
  }
}

TEST(GeoreferenceReconstruction, BlamesAModelThatFoldsWhereGnssRunsOn) {
  DrivenStreet street = Drive({.panoramas = 90, .sigma_m = 2.0}, 7);
  // The facades repeat: every thirty panoramas the model is back where it was.
  for (auto& [id, image] : street.model.images)
    image.cam_from_world = street.model.images.at(ImageId(id.value % 30)).cam_from_world;
  const Georeference georeference =
      GeoreferenceReconstruction(street.model, street.manifest, GnssUse::kAuto, {}).value();
  EXPECT_FALSE(georeference.enu_from_world.has_value());
  ASSERT_EQ(georeference.checks.size(), 1U);
  EXPECT_EQ(georeference.checks[0].name, "gnss_against_model");
  EXPECT_EQ(georeference.checks[0].level, CheckLevel::kBad);
  EXPECT_NE(georeference.reason.find("the model contradicts GNSS"), std::string::npos)
      << georeference.reason;
}

// Two days in stretches of six panoramas round a block; what a receiver does between houses.
FoundDriveErrors OfRealisticStreet(uint64_t seed, double late_s) {
  StreetOptions options;
  options.panoramas = 60;
  options.spacing_m = 8.0;
  options.seed = seed;
  options = RealisticStreet(options);
  options.hardships.gnss_late_s = late_s;
  options.hardships.gnss_datum_m = 0.0;
  const Street street = MakeStreet(options);
  Reconstruction model;
  ImageManifest manifest;
  for (uint32_t i = 0; i < street.names.size(); ++i) {
    ImageRecord& image = manifest.images.emplace_back();
    image.id = ImageId(i);
    image.name = street.names[i];
    image.drive = street.on_second_day[i] ? 1 : 0;
    image.capture_time_s = street.capture_times_s[i];
    image.prior.position_in_enu = street.measured_in_enu[i];
    image.prior.horizontal_sigma_m = options.gnss_sigma_m;
    image.prior.vertical_sigma_m = 2.0 * options.gnss_sigma_m;
    model.images[image.id].cam_from_world = street.cams_from_enu[i];
  }
  return FindDriveErrors(GnssDrivesOf(model, manifest), Sim3{});
}

TEST(FindDriveErrors, ClocksOfStretchesAreRightWhereErrorsOfNeighboursAreAlike) {
  size_t allowed_for = 0;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    const FoundDriveErrors found = OfRealisticStreet(seed, 0.0);
    for (const DriveErrors& errors : found.drives) EXPECT_EQ(errors.ahead, 0.0) << seed;
    allowed_for += found.drives.size();
  }
  EXPECT_LE(allowed_for, 2U) << "of 120 drives";
}

TEST(FindDriveErrors, FindsALateClockOfStretches) {
  size_t told = 0;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const FoundDriveErrors found = OfRealisticStreet(seed, 1.0);
    for (const DriveErrors& errors : found.drives)
      EXPECT_NEAR(errors.ahead, -1.0, 4.0 * errors.ahead_sigma) << seed;
    told += found.drives.size();
  }
  EXPECT_GE(told, 12U) << "of 20 drives";
}

// t of 0.99865 and of 0.99997: tables of Student's distribution.
TEST(FitUncertainty, BoundsAreStudentsQuantiles) {
  const auto bound = [](double freedoms, double deviations) {
    const double sigma = std::sqrt(freedoms / (freedoms - 2.0));
    return FitUncertainty{Eigen::VectorXd::Constant(1, sigma), freedoms}.Bound(0, deviations);
  };
  EXPECT_NEAR(bound(6.0, 3.0), 4.90, 0.1);
  EXPECT_NEAR(bound(10.0, 3.0), 3.96, 0.03);
  EXPECT_NEAR(bound(30.0, 4.0), 4.63, 0.03);
  EXPECT_NEAR(bound(1e6, 4.0), 4.0, 1e-3);
}

}  // namespace
}  // namespace orbweave
