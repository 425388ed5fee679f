// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_lengths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr uint32_t kImages = 100;

/// A model of a drive, with the pairs of each image with the three after it, and the way to the
/// next: 70 % of the rays of each agree.
JobResults Drive() {
  JobResults results;
  results.clusters.emplace_back();
  results.models.emplace_back();
  for (uint32_t a = 0; a < kImages; ++a) {
    ImageRecord& image = results.manifest.images.emplace_back();
    image.id = ImageId(a);
    image.name = std::to_string(a) + ".jpg";
    results.models[0].images[image.id] = {};
    for (uint32_t b = a + 1; b < std::min(a + 4, kImages); ++b) {
      results.clusters[0].pair_lengths.push_back(
          {{ImageId(a), ImageId(b)}, {.told = 100.0, .agreeing = 70.0}});
    }
    if (a + 1 == kImages) continue;
    results.clusters[0].gap_lengths.push_back(
        {{ImageId(a), ImageId(a + 1)}, 6, {.told = 300.0, .agreeing = 210.0}});
  }
  return results;
}

void ContradictPairsOf(uint32_t image, JobResults& results) {
  for (PairLength& length : results.clusters[0].pair_lengths) {
    if (length.pair.a.value == image || length.pair.b.value == image)
      length.agreement.agreeing = 15.0;
  }
}

TEST(CheckLengths, IsGoodWhereRaysAgree) {
  const CrossCheck check = CheckLengths(Drive());
  EXPECT_EQ(check.level, CheckLevel::kGood);
  EXPECT_DOUBLE_EQ(check.value, 0.7);
  EXPECT_THAT(check.sentence, HasSubstr("70 %"));
  EXPECT_EQ(CheckLengths({}).level, CheckLevel::kGood);
}

TEST(CheckLengths, OneImageIsDoubtfulAndNamed) {
  JobResults results = Drive();
  ContradictPairsOf(42, results);
  const CrossCheck check = CheckLengths(results);
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_DOUBLE_EQ(check.value, 0.15);
  EXPECT_THAT(check.sentence, HasSubstr("only 15 % agree with the model at 42.jpg"));
  EXPECT_THAT(check.sentence, Not(HasSubstr("more")));
  EXPECT_THAT(check.sentence, HasSubstr("give GNSS positions"));
  EXPECT_THAT(check.sentence, Not(HasSubstr("features.facades"))) << "the first pairs ask for them";
}

TEST(CheckLengths, ManyAreBad) {
  JobResults results = Drive();
  for (const uint32_t image : {10U, 50U, 80U}) ContradictPairsOf(image, results);
  EXPECT_EQ(CheckLengths(results).level, CheckLevel::kBad);
}

TEST(CheckLengths, ATearIsDoubtful) {
  JobResults results = Drive();
  for (const uint32_t before : {20U, 50U, 80U})
    results.clusters[0].gap_lengths[before].agreement.agreeing = 45.0;
  const CrossCheck check = CheckLengths(results);
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_THAT(check.sentence, HasSubstr("between 20.jpg and 21.jpg"));
  EXPECT_THAT(check.sentence,
              HasSubstr("2 more places are doubted: between 50.jpg and 51.jpg, between "
                        "80.jpg and 81.jpg"));
  results.models.emplace_back();
  for (const uint32_t beyond : {21U, 51U, 81U}) {
    results.models[0].images.erase(ImageId(beyond));
    results.models[1].images[ImageId(beyond)] = {};
  }
  EXPECT_EQ(CheckLengths(results).level, CheckLevel::kGood) << "gaps between two models";
}

/// Of a drive whose first cluster has that gap behind image 20; a second one finds nothing wrong.
void ExpectDoubtWhicheverClusterSaysSo(JobResults results, const std::string& sentence) {
  results.clusters.push_back(Drive().clusters[0]);
  for (const size_t says_so : {0U, 1U}) {
    const CrossCheck check = CheckLengths(results);
    EXPECT_EQ(check.level, CheckLevel::kDoubtful) << says_so;
    EXPECT_LT(check.value, check.limit);
    EXPECT_THAT(check.sentence, HasSubstr(sentence));
    std::swap(results.clusters[0], results.clusters[1]);
  }
}

TEST(CheckLengths, WhatGnssOrACrowdOfRaysBearsOutIsNoFault) {
  JobResults results = Drive();
  results.models[0].report.gnss.used = true;
  std::vector<GapLength>& gaps = results.clusters[0].gap_lengths;
  ContradictPairsOf(42, results);
  gaps[41].agreement.agreeing = 30.0;
  gaps[42].here = 60.0;
  gaps[42].elsewhere = 132.0;
  EXPECT_EQ(CheckLengths(results).level, CheckLevel::kDoubtful);
  gaps[41].is_borne_out = true;
  EXPECT_EQ(CheckLengths(results).level, CheckLevel::kDoubtful) << "the image, the way behind it";
  gaps[42].is_borne_out = true;
  EXPECT_EQ(CheckLengths(results).level, CheckLevel::kGood);
  gaps[42].matches = {.told = 582.0, .agreeing = 62.0};
  EXPECT_EQ(CheckLengths(results).level, CheckLevel::kDoubtful) << "sides that stand askew";
}

TEST(CheckLengths, AStepThatIsToldFarLessThanOthersIsDoubtfulWithoutGnss) {
  JobResults results = Drive();
  GapLength& gap = results.clusters[0].gap_lengths[20];
  gap.agreement.agreeing = 0.36 * gap.agreement.told;
  EXPECT_EQ(CheckLengths(results).level, CheckLevel::kGood);
  gap.agreement.agreeing = 0.34 * gap.agreement.told;
  const CrossCheck check = CheckLengths(results);
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_NEAR(check.value, 0.34, 1e-12);
  EXPECT_NEAR(check.limit, 0.35, 1e-12);
  EXPECT_THAT(check.sentence,
              HasSubstr("only 34 % agree with the model between 20.jpg and 21.jpg, where 70 %"));
  gap.is_borne_out = true;
  gap.here = 35.0;
  EXPECT_EQ(CheckLengths(results).level, CheckLevel::kDoubtful);
  gap.here = 36.0;
  EXPECT_EQ(CheckLengths(results).level, CheckLevel::kGood);
  gap.is_borne_out = false;
  results.models[0].report.gnss.used = true;
  EXPECT_EQ(CheckLengths(results).level, CheckLevel::kGood) << "its sigmas hold it";
}

TEST(CheckLengths, MoreRaysForAnotherLengthAreDoubtful) {
  JobResults results = Drive();
  results.clusters[0].gap_lengths[20].here = 60.0;
  results.clusters[0].gap_lengths[20].elsewhere = 132.0;
  ExpectDoubtWhicheverClusterSaysSo(
      results,
      "132 say another length than the model has between 20.jpg and 21.jpg, and 60 the model's");
}

TEST(CheckLengths, OneSideOfTheStreetAloneIsDoubtful) {
  JobResults results = Drive();
  results.clusters[0].gap_lengths[20].wall = {.told = 177.0, .agreeing = 75.0};
  ExpectDoubtWhicheverClusterSaysSo(
      results,
      "of the rays to one side of the street that tell how long steps are, 102 say another length "
      "than the model has between 20.jpg and 21.jpg, and 75 the model's");
  results.models[0].report.gnss.used = true;
  EXPECT_EQ(CheckLengths(results).level, CheckLevel::kGood) << "its sigmas hold it";
}

TEST(CheckLengths, APartOnAScaleOfItsOwnIsDoubtful) {
  JobResults results = Drive();
  results.clusters[0].gap_lengths[20].scale_jump = std::log(25.0);
  ExpectDoubtWhicheverClusterSaysSo(
      results,
      "between 20.jpg and 21.jpg steps are longer and what is seen is farther away, by 25");
}

TEST(CheckLengths, AHingeIsDoubtfulWhicheverClusterSaysSo) {
  JobResults results = Drive();
  results.clusters[0].gap_lengths[20].matches = {.told = 582.0, .agreeing = 62.0};
  ExpectDoubtWhicheverClusterSaysSo(
      results,
      "only 11 % agree with the model between 20.jpg and 21.jpg, whose two sides stand askew");
}

TEST(CheckLengths, TheClusterThatSpeaksForAPairLessJudgesIt) {
  JobResults results = Drive();
  results.clusters.push_back(results.clusters[0]);
  ContradictPairsOf(42, results);
  EXPECT_EQ(CheckLengths(results).level, CheckLevel::kDoubtful);
  std::swap(results.clusters[0], results.clusters[1]);
  EXPECT_EQ(CheckLengths(results).level, CheckLevel::kDoubtful);
}

TEST(CheckLengths, ImagesThatAreNotInAModelAreNotAsked) {
  JobResults results = Drive();
  ContradictPairsOf(42, results);
  ContradictPairsOf(60, results);
  results.models[0].images.erase(ImageId(42));
  results.models[0].images[ImageId(60)].loose = true;
  EXPECT_EQ(CheckLengths(results).level, CheckLevel::kGood);
}

}  // namespace
}  // namespace orbweave
