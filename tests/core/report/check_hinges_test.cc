// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_hinges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

constexpr uint32_t kImages = 30;
constexpr uint32_t kHinge = 22;
constexpr double kStep_m = 10.0;

/// A straight drive whose last panoramas hang at the others by seven points.
JobResults Hinged() {
  JobResults results;
  AdjustedModel& model = results.models.emplace_back();
  HingedPiece& piece = model.hinged_pieces.emplace_back();
  piece.points = 7;
  for (uint32_t i = 0; i < kImages; ++i) {
    ImageRecord& image = results.manifest.images.emplace_back();
    image.id = ImageId(i);
    image.name = std::to_string(i) + ".jpg";
    model.images[image.id].cam_from_world =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {kStep_m * i, 0.0, 0.0});
    if (i >= kHinge) piece.images.push_back(image.id);
  }
  return results;
}

JobResults WithGnss(double sigma_m) {
  JobResults results = Hinged();
  results.models[0].report.gnss.used = true;
  for (ImageRecord& image : results.manifest.images) {
    image.prior.position_in_enu = Eigen::Vector3d(kStep_m * image.id.value, 0.0, 0.0);
    image.prior.horizontal_sigma_m = sigma_m;
  }
  return results;
}

TEST(CheckHinges, IsGoodWhereNothingHangs) {
  JobResults results = Hinged();
  results.models[0].hinged_pieces.clear();
  EXPECT_EQ(CheckHinges(results).level, CheckLevel::kGood);
  EXPECT_EQ(CheckHinges({}).level, CheckLevel::kGood);
}

TEST(CheckHinges, DoubtsWhatHangsAtFewPoints) {
  const CrossCheck check = CheckHinges(Hinged());
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_EQ(check.value, 7.0);
  EXPECT_THAT(check.sentence, HasSubstr("8 panoramas (pieces: 1)"));
  EXPECT_THAT(check.sentence, HasSubstr("first 22.jpg beside 21.jpg, by 7"));
}

TEST(CheckHinges, AsksNothingThatGnssBearsOut) {
  EXPECT_EQ(CheckHinges(WithGnss(3.0)).level, CheckLevel::kGood);
  EXPECT_EQ(CheckHinges(WithGnss(30.0)).level, CheckLevel::kDoubtful);
  JobResults contradicted = WithGnss(3.0);
  for (uint32_t i = kHinge; i < kHinge + 4; ++i)
    contradicted.models[0].report.gnss.outliers.push_back(contradicted.manifest.images[i].name);
  EXPECT_EQ(CheckHinges(contradicted).level, CheckLevel::kDoubtful);
  JobResults unused = WithGnss(3.0);
  unused.models[0].report.gnss.used = false;
  EXPECT_EQ(CheckHinges(unused).level, CheckLevel::kDoubtful);
}

}  // namespace
}  // namespace orbweave
