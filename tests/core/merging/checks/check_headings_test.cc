// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_headings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "tests/core/merging/driven_street.h"

namespace orbweave {
namespace {

using testing::Drive;
using testing::DrivenStreet;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kDegPerRad = 180.0 / EIGEN_PI;

/// States the heading of every panorama of a street that turns, to 2 degrees, after `change`.
DrivenStreet Street(const std::function<double(double)>& change) {
  DrivenStreet street = Drive({.turn_rad = 1.6, .sway_rad = 0.03}, 1);
  for (ImageRecord& image : street.manifest.images) {
    image.name = "pano_" + std::to_string(image.id.value);
    const Eigen::Vector3d forward =
        street.model.images.at(image.id).cam_from_world.rotation.conjugate() *
        Eigen::Vector3d::UnitZ();
    image.prior.heading_deg = change(kDegPerRad * std::atan2(forward.x(), forward.y()));
    image.prior.heading_sigma_deg = 2.0;
  }
  return street;
}

CrossCheck Check(const DrivenStreet& street, bool is_georeferenced = true) {
  return CheckHeadings(street.model.images, street.manifest, is_georeferenced)
      .value_or(CrossCheck{});
}

TEST(CheckHeadings, BelievesWhatAgreesAcrossTheNorthToo) {
  for (const double turn_deg : {0.0, 360.0, -360.0}) {
    const CrossCheck check = Check(Street([&](double deg) { return deg + turn_deg; }));
    EXPECT_EQ(check.level, CheckLevel::kGood);
    EXPECT_LT(check.value, 0.01);
    EXPECT_THAT(check.sentence, HasSubstr("60 panoramas"));
    EXPECT_THAT(check.sentence, Not(HasSubstr("but for")));
  }
}

TEST(CheckHeadings, SaysThatAllAreOffAlikeWhereGnssTells) {
  const DrivenStreet street = Street([](double deg) { return deg + 270.0; });
  const CrossCheck check = Check(street);
  EXPECT_EQ(check.level, CheckLevel::kGood) << "the model is right";
  EXPECT_THAT(check.sentence, HasSubstr("but for -90.0 deg that all of them are off"));
  EXPECT_THAT(Check(street, false).sentence, Not(HasSubstr("but for")));
}

TEST(CheckHeadings, DoubtsWhatScattersByMoreThanItsAccuracy) {
  Random random(3);
  const auto scattered = [&](double sigma_deg) {
    return Street([&](double deg) { return deg + sigma_deg * random.Normal(); });
  };
  EXPECT_EQ(Check(scattered(2.0)).level, CheckLevel::kGood);
  const CrossCheck check = Check(scattered(40.0));
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_THAT(check.sentence, HasSubstr("the drive of pano_0, are off by"));
}

TEST(CheckHeadings, TellsHeadingsThatCountTheOtherWay) {
  const CrossCheck check = Check(Street([](double deg) { return -deg; }));
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_THAT(check.sentence, HasSubstr("counter-clockwise"));
}

TEST(CheckHeadings, IsSilentWhereHardlyAnyAreStated) {
  DrivenStreet street = Street([](double deg) { return deg; });
  for (ImageRecord& image : street.manifest.images) {
    if (image.id.value > 8) image.prior.heading_deg.reset();
  }
  EXPECT_FALSE(CheckHeadings(street.model.images, street.manifest, true).has_value());
}

}  // namespace
}  // namespace orbweave
