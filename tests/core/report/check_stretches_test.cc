// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_stretches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

constexpr uint32_t kImages = 30;
constexpr double kStep_m = 10.0;

/// A model of a straight drive whose positions are those of its images.
JobResults Drive() {
  JobResults results;
  AdjustedModel& model = results.models.emplace_back();
  model.report.gnss.used = true;
  for (uint32_t i = 0; i < kImages; ++i) {
    ImageRecord& image = results.manifest.images.emplace_back();
    image.id = ImageId(i);
    image.name = std::to_string(i) + ".jpg";
    image.prior.position_in_enu = Eigen::Vector3d(kStep_m * i, 0.0, 0.0);
    image.prior.horizontal_sigma_m = 3.0;
    model.images[image.id].cam_from_world =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), *image.prior.position_in_enu);
  }
  return results;
}

void Contradict(uint32_t from, uint32_t to, JobResults& results) {
  for (uint32_t i = from; i < to; ++i)
    results.models[0].report.gnss.outliers.push_back(results.manifest.images[i].name);
}

/// The end of the drive from an image on, shrunk by a factor in the model, and contradicted.
JobResults Shrunk(uint32_t from, double factor) {
  JobResults results = Drive();
  for (uint32_t i = from; i < kImages; ++i) {
    const double x = kStep_m * (from + factor * (i - from));
    results.models[0].images[ImageId(i)].cam_from_world =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {x, 0.0, 0.0});
  }
  Contradict(from + 1, kImages, results);
  return results;
}

TEST(CheckStretches, IsGoodWhereNothingIsContradicted) {
  EXPECT_EQ(CheckStretches(Drive()).level, CheckLevel::kGood);
  EXPECT_EQ(CheckStretches({}).level, CheckLevel::kGood);
}

TEST(CheckStretches, DoubtsAStreetOfAnotherScale) {
  for (const double factor : {0.25, 3.0}) {
    const CrossCheck check = CheckStretches(Shrunk(20, factor));
    EXPECT_EQ(check.level, CheckLevel::kDoubtful) << factor;
    EXPECT_NEAR(check.value, std::max(factor, 1.0 / factor), 1e-9);
    EXPECT_THAT(check.sentence, HasSubstr("9 panoramas in a row, from 21.jpg to 29.jpg"));
  }
  EXPECT_EQ(CheckStretches(Shrunk(20, 0.8)).level, CheckLevel::kGood);
}

TEST(CheckStretches, DoubtsManyThatAreAFifthTooFarApartRoundACorner) {
  JobResults results = Drive();
  const auto corner = [](double way_m) {
    return way_m < 150.0 ? Eigen::Vector3d(way_m, 0.0, 0.0)
                         : Eigen::Vector3d(150.0, way_m - 150.0, 0.0);
  };
  for (uint32_t i = 0; i < kImages; ++i) {
    ImageRecord& image = results.manifest.images[i];
    image.prior.position_in_enu = corner(kStep_m * i);
    image.prior.position_in_enu->x() += i % 3 == 0 ? 2.0 : -1.0;
    image.prior.horizontal_sigma_m = 1.5;
    const Eigen::Vector3d centre = corner(kStep_m * 5) + 1.2 * (corner(kStep_m * i) - corner(50.0));
    results.models[0].images[image.id].cam_from_world =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), centre);
  }
  Contradict(8, 24, results);
  const CrossCheck check = CheckStretches(results);
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_NEAR(check.value, 1.2, 0.03);
  EXPECT_THAT(check.sentence, HasSubstr("16 panoramas in a row, from 8.jpg to 23.jpg"));
}

TEST(CheckStretches, DoesNotBlameTheModelForAReceiverThatJumpsOrScatters) {
  JobResults jump = Drive();
  for (uint32_t i = 8; i < 20; ++i) jump.manifest.images[i].prior.position_in_enu->y() += 100.0;
  Contradict(8, 20, jump);
  EXPECT_EQ(CheckStretches(jump).level, CheckLevel::kGood);
  JobResults scatter = Drive();
  for (uint32_t i = 8; i < 14; ++i)
    scatter.manifest.images[i].prior.position_in_enu->y() += i % 2 == 0 ? 60.0 : -80.0;
  Contradict(8, 14, scatter);
  EXPECT_EQ(CheckStretches(scatter).level, CheckLevel::kGood);
}

}  // namespace
}  // namespace orbweave
