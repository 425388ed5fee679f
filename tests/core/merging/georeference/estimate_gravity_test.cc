// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/estimate_gravity.h"

#include <gtest/gtest.h>

#include "core/merging/georeference/drive_attitudes.h"
#include "tests/core/merging/driven_street.h"

namespace orbweave {
namespace {

using testing::AddDrive;
using testing::Drive;
using testing::DrivenStreet;

const Eigen::Quaterniond kLean = RotationFromVector({0.0, 0.0, -0.2});
const Eigen::Vector3d kDown = -Eigen::Vector3d::UnitZ();

TEST(DownInCamera, IsWhereALeaningCameraSeesDown) {
  EXPECT_LT((DownInCamera(0.0, 0.0) - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT(DownInCamera(0.1, 0.0).z(), 0.0);  // looks up: down is behind
  EXPECT_GT(DownInCamera(0.0, 0.1).x(), 0.0);  // clockwise: the right side is lower
  EXPECT_NEAR(DownInCamera(0.3, -0.4).norm(), 1.0, 1e-15);
}

TEST(EstimateGravity, FindsTheLeanOfAMountWhereTheDriveTurns) {
  const DrivenStreet street = Drive({.turn_rad = 1.6, .mount = kLean, .sway_rad = 0.015}, 1);
  const std::optional<Gravity> gravity = EstimateGravity(street.model, street.manifest);
  ASSERT_TRUE(gravity.has_value());
  EXPECT_LT(AngleBetween(gravity->down_in_world, kDown), 0.02);
  EXPECT_LT(gravity->sigma_rad, 0.06);
  EXPECT_LT(gravity->mount_sigma_rad.at(0), 0.06);
  EXPECT_LT(AngleBetween(gravity->down_in_mount.at(0), kLean * Eigen::Vector3d::UnitY()), 0.03);
}

TEST(EstimateGravity, OwnsThatItMayBeWrongOnAStraightStreet) {
  const DrivenStreet street = Drive({.mount = kLean, .sway_rad = 0.015}, 2);
  const std::optional<Gravity> gravity = EstimateGravity(street.model, street.manifest);
  ASSERT_TRUE(gravity.has_value());
  EXPECT_NEAR(AngleBetween(gravity->down_in_world, kDown), 0.2, 0.02);
  EXPECT_NEAR(gravity->sigma_rad, kMountSigma_rad, 0.01);
  EXPECT_NEAR(gravity->mount_sigma_rad.at(0), kMountSigma_rad, 0.01);
}

TEST(EstimateGravity, TakesPanoramasThatKeepTheirHeadingForLevelled) {
  const DrivenStreet street = Drive({.turn_rad = 1.6, .keeps_heading = true, .sway_rad = 0.03}, 2);
  const std::optional<Gravity> gravity = EstimateGravity(street.model, street.manifest);
  ASSERT_TRUE(gravity.has_value());
  EXPECT_LT(AngleBetween(gravity->down_in_world, kDown), 0.02);
  EXPECT_LT(gravity->sigma_rad, 0.6 * kMountSigma_rad);
  EXPECT_LT(gravity->SigmaAt(0.2), 0.6 * kMountSigma_rad);  // no mount's doing
}

TEST(EstimateGravity, CannotTellWhoHoldsTheHeadingOfAStraightStreet) {
  const DrivenStreet street = Drive({.keeps_heading = true, .sway_rad = 0.03}, 2);
  const std::optional<Gravity> gravity = EstimateGravity(street.model, street.manifest);
  ASSERT_TRUE(gravity.has_value());
  EXPECT_NEAR(gravity->sigma_rad, kMountSigma_rad, 0.01);
}

TEST(EstimateGravity, TakesAwayWhatPitchAndRollSay) {
  DrivenStreet street = Drive({.mount = kLean, .sway_rad = 0.015}, 3);
  for (ImageRecord& image : street.manifest.images) {
    const Eigen::Vector3d down = street.model.images.at(image.id).cam_from_world.rotation * kDown;
    image.prior.pitch_deg = -std::asin(down.z()) * 180.0 / EIGEN_PI;
    image.prior.roll_deg = std::atan2(down.x(), down.y()) * 180.0 / EIGEN_PI;
    image.prior.tilt_sigma_deg = 1.0;
  }
  const std::optional<Gravity> gravity = EstimateGravity(street.model, street.manifest);
  ASSERT_TRUE(gravity.has_value());
  EXPECT_LT(AngleBetween(gravity->down_in_world, kDown), 1e-3);
  EXPECT_NEAR(gravity->sigma_rad, 0.0175, 0.03);
}

TEST(EstimateGravity, TurnsWithTheWorld) {
  DrivenStreet street = Drive({.turn_rad = 1.0, .mount = kLean, .sway_rad = 0.015}, 4);
  const std::optional<Gravity> before = EstimateGravity(street.model, street.manifest);
  const Sim3 turn{3.0, RotationFromVector({0.7, -1.1, 0.4}), {1.0, 2.0, 3.0}};
  street.model = Transformed(turn, std::move(street.model));
  const std::optional<Gravity> after = EstimateGravity(street.model, street.manifest);
  ASSERT_TRUE(before && after);
  EXPECT_LT(AngleBetween(turn.rotation * before->down_in_world, after->down_in_world), 1e-6);
}

TEST(EstimateGravity, KnowsEveryDrivesMount) {
  Random random(5);
  DrivenStreet street;
  AddDrive({.turn_rad = 1.5, .mount = kLean, .sway_rad = 0.01}, random, street);
  AddDrive({.turn_rad = 1.5, .sway_rad = 0.01}, random, street);
  const std::optional<Gravity> gravity = EstimateGravity(street.model, street.manifest);
  ASSERT_TRUE(gravity.has_value());
  EXPECT_LT(AngleBetween(gravity->down_in_world, kDown), 0.02);
  EXPECT_LT(AngleBetween(gravity->down_in_mount.at(0), kLean * Eigen::Vector3d::UnitY()), 0.03);
  EXPECT_LT(AngleBetween(gravity->down_in_mount.at(1), Eigen::Vector3d::UnitY()), 0.03);
}

TEST(EstimateGravity, IsNotMisledByHillsInAStreetThatTurns) {
  for (uint64_t seed = 6; seed < 12; ++seed) {
    const DrivenStreet street = Drive({.panoramas = 90,
                                       .turn_rad = 1.2,
                                       .turn_share = 1.0,
                                       .sway_rad = 0.015,
                                       .slope_rad = 0.15,
                                       .hill_panoramas = 50 + 10 * static_cast<int>(seed)},
                                      seed);
    const std::optional<Gravity> gravity = EstimateGravity(street.model, street.manifest);
    ASSERT_TRUE(gravity.has_value());
    EXPECT_LT(AngleBetween(gravity->down_in_world, kDown), 0.05) << seed;
    EXPECT_LT(gravity->sigma_rad, 0.2);
  }
}

TEST(EstimateGravity, TellsAMountThatLeansFarOnFlatGroundFromHills) {
  for (uint64_t seed = 0; seed < 6; ++seed) {
    const DrivenStreet street = Drive({.panoramas = 90,
                                       .turn_rad = 1.0,
                                       .mount = RotationFromVector({0.0, 0.0, -0.3}),
                                       .sway_rad = 0.015},
                                      seed);
    const std::optional<Gravity> gravity = EstimateGravity(street.model, street.manifest);
    ASSERT_TRUE(gravity.has_value());
    EXPECT_LT(AngleBetween(gravity->down_in_world, kDown), 0.05) << seed;
  }
}

TEST(EstimateGravity, ClaimsWhatItMayBeOffByOnHillsAndWithMountsThatLean) {
  for (const double slope_rad : {0.0, 0.05, 0.1, 0.15}) {
    for (const double turn_rad : {0.6, 1.0, 1.6, 3.1}) {
      for (const double lean_rad : {0.0, 0.1, 0.2}) {
        for (uint64_t seed = 0; seed < 6; ++seed) {
          const DrivenStreet street = Drive({.panoramas = 90,
                                             .turn_rad = turn_rad,
                                             .turn_share = 1.0,
                                             .mount = RotationFromVector({0.0, 0.0, -lean_rad}),
                                             .sway_rad = 0.015,
                                             .slope_rad = slope_rad,
                                             .hill_panoramas = 40 + 16 * static_cast<int>(seed)},
                                            seed);
          const std::optional<Gravity> gravity = EstimateGravity(street.model, street.manifest);
          ASSERT_TRUE(gravity.has_value());
          EXPECT_LT(AngleBetween(gravity->down_in_world, kDown), 3.0 * gravity->sigma_rad)
              << slope_rad << " " << turn_rad << " " << lean_rad << " " << seed;
        }
      }
    }
  }
}

TEST(EstimateGravity, IsSilentAboutNothing) { EXPECT_FALSE(EstimateGravity({}, {}).has_value()); }

}  // namespace
}  // namespace orbweave
