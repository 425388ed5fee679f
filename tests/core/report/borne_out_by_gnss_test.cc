// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/borne_out_by_gnss.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// A drive of 40 images, 5 m apart, whose model lies where GNSS of 1 m says.
JobResults Drive() {
  JobResults results;
  results.models.emplace_back().report.gnss.used = true;
  for (uint32_t i = 0; i < 40; ++i) {
    ImageRecord& image = results.manifest.images.emplace_back();
    image.id = ImageId(i);
    image.name = std::to_string(i) + ".jpg";
    image.prior.position_in_enu = Vector3d(5.0 * i, i % 2, 30.0);
    image.prior.horizontal_sigma_m = 1.0;
    results.models[0].images[ImageId(i)].cam_from_world =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), Vector3d(5.0 * i, 0.0, 0.0));
  }
  return results;
}

bool AreApart(const JobResults& results, uint32_t a, uint32_t b) {
  return BorneOutByGnss(results).AreApart({ImageId(a), ImageId(b)});
}

TEST(BorneOutByGnss, ImagesThatSeeNothingInCommonAreApart) {
  const JobResults results = Drive();
  EXPECT_TRUE(AreApart(results, 10, 14));  // 20 m: three steps of 5.1 m and three times 1 m
  EXPECT_FALSE(AreApart(results, 10, 13));
  EXPECT_TRUE(AreApart(results, 0, 39));
}

TEST(BorneOutByGnss, SinglePositionsThatAreOffOrMissingChangeNothing) {
  JobResults results = Drive();
  results.manifest.images[10].prior.position_in_enu.reset();
  *results.manifest.images[12].prior.position_in_enu += Vector3d(0.0, 40.0, 0.0);
  EXPECT_TRUE(AreApart(results, 10, 30));
  EXPECT_TRUE(AreApart(results, 12, 30));
}

// Of the six positions about an end of the drive three are off, as between houses.
TEST(BorneOutByGnss, WhatTheMotionOfTheDriveShowsToBeOffDoesNotCount) {
  JobResults results = Drive();
  for (const uint32_t i : {34u, 36u, 38u})
    *results.manifest.images[i].prior.position_in_enu += Vector3d(-30.0, 50.0, 0.0);
  EXPECT_FALSE(AreApart(results, 2, 39));
  for (ImageRecord& image : results.manifest.images)
    image.capture_time_s = 1'700'000'000.0 + image.id.value;
  EXPECT_TRUE(AreApart(results, 2, 39));
}

TEST(BorneOutByGnss, AStretchThatStandsElsewhereIsNotBorneOut) {
  JobResults results = Drive();
  for (uint32_t i = 0; i < 12; ++i) {  // folded onto the end
    results.models[0].images[ImageId(i)].cam_from_world =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), Vector3d(195.0 - 5.0 * i, 0.0, 0.0));
  }
  EXPECT_FALSE(AreApart(results, 5, 30));
  EXPECT_TRUE(AreApart(results, 20, 30));
}

TEST(BorneOutByGnss, NothingIsWithoutGnssOrInTwoModels) {
  JobResults results = Drive();
  results.models.emplace_back().report.gnss.used = true;
  for (uint32_t i = 20; i < 40; ++i)
    results.models[1].images.insert(results.models[0].images.extract(ImageId(i)));
  EXPECT_FALSE(AreApart(results, 10, 30));
  EXPECT_TRUE(AreApart(results, 2, 10));
  for (AdjustedModel& model : results.models) model.report.gnss.used = false;
  EXPECT_FALSE(AreApart(results, 2, 10));
  EXPECT_FALSE(AreApart({.manifest = results.manifest}, 2, 10));
}

}  // namespace
}  // namespace orbweave
