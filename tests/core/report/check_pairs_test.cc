// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_pairs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

/// A drive of 100 images whose pairs of neighbours the model explains.
JobResults Drive() {
  JobResults results;
  results.clusters.emplace_back();
  for (uint32_t i = 0; i < 100; ++i) {
    ImageRecord& image = results.manifest.images.emplace_back();
    image.id = ImageId(i);
    image.name = std::to_string(i) + ".jpg";
    if (i > 0) results.clusters[0].explained_pairs.push_back({ImageId(i - 1), ImageId(i)});
  }
  return results;
}

CrossCheck Checked(const JobResults& results) {
  return CheckPairs(results, JudgePairsOfJob(results), BorneOutByGnss(results));
}

void Contradict(uint32_t a, uint32_t b, JobResults& results) {
  results.clusters[0].contradicted_pairs.push_back({ImageId(a), ImageId(b)});
}

TEST(CheckPairs, AModelThatExplainsItsPairsIsGood) {
  const CrossCheck check = Checked(Drive());
  EXPECT_EQ(check.level, CheckLevel::kGood);
  EXPECT_EQ(check.value, 1.0);
  EXPECT_EQ(Checked({}).level, CheckLevel::kGood);
}

TEST(CheckPairs, ScatteredLookAlikesAreNoReasonForDoubt) {
  JobResults results = Drive();
  for (uint32_t i = 0; i < 20; ++i) Contradict(i * 2, 50 + (i * 7) % 40, results);
  const CrossCheck check = Checked(results);
  EXPECT_EQ(check.level, CheckLevel::kGood);
  EXPECT_THAT(check.sentence, HasSubstr("20 pairs of others contradict it"));
}

TEST(CheckPairs, RunsOfContradictedPairsAreDoubtfulInBothDirections) {
  JobResults there = Drive();
  JobResults back = Drive();
  for (uint32_t i = 0; i < 5; ++i) {
    Contradict(10 + i, 60 + i, there);
    Contradict(10 + i, 60 - i, back);
  }
  for (const JobResults& results : {there, back}) {
    EXPECT_EQ(Checked(results).level, CheckLevel::kDoubtful);
    EXPECT_THAT(Checked(results).sentence, HasSubstr("up to 5 in a row"));
  }
}

/// Images are called as they like; times tell how they follow one another.
TEST(CheckPairs, RunsFollowTheDriveAndNotTheNames) {
  JobResults results = Drive();
  for (ImageRecord& image : results.manifest.images)
    image.capture_time_s = (37 * image.id.value) % 100;
  const auto taken_as = [](uint32_t place) {
    return (73 * place) % 100;
  };  // 37 x 73 = 27 x 100 + 1
  for (uint32_t i = 0; i < 5; ++i) {
    const auto [a, b] = std::minmax({taken_as(10 + i), taken_as(60 - i)});
    Contradict(a, b, results);
  }
  EXPECT_THAT(Checked(results).sentence, HasSubstr("up to 5 in a row"));
}

TEST(CheckPairs, RunsThatGnssPutsApartAreLookAlikes) {
  JobResults results = Drive();
  for (uint32_t i = 0; i < 5; ++i) Contradict(10 + i, 60 + i, results);
  results.models.emplace_back().report.gnss.used = true;
  for (ImageRecord& image : results.manifest.images) {
    image.prior.position_in_enu = Eigen::Vector3d(3.0 * image.id.value, 0.0, 0.0);
    results.models[0].images[image.id].cam_from_world =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), *image.prior.position_in_enu);
  }
  EXPECT_EQ(Checked(results).level, CheckLevel::kGood);
  results.models[0].report.gnss.used = false;
  const CrossCheck check = Checked(results);
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_EQ(check.value, 5.0) << "in a row, not the share that is explained";
  EXPECT_EQ(check.unit, "count");
  EXPECT_FALSE(check.IsWithinLimit());
}

TEST(CheckPairs, ATornStreetIsBad) {
  JobResults results = Drive();
  EXPECT_TRUE(Checked(results).IsWithinLimit());
  Contradict(40, 41, results);
  EXPECT_EQ(Checked(results).level, CheckLevel::kDoubtful);
  EXPECT_FALSE(Checked(results).IsWithinLimit());
  Contradict(40, 42, results);
  Contradict(70, 71, results);
  const CrossCheck check = Checked(results);
  EXPECT_EQ(check.level, CheckLevel::kBad);
  EXPECT_LT(check.value, check.limit);
  EXPECT_THAT(check.sentence, HasSubstr("first 40.jpg and 41.jpg"));
}

/// Windows that repeat fool one pair of neighbours; those across it are not.
TEST(CheckPairs, APairThatIsOutvotedByThoseAcrossItIsNoTear) {
  JobResults results = Drive();
  for (uint32_t i = 0; i + 3 < 100; ++i) {
    for (const uint32_t step : {2U, 3U})
      results.clusters[0].explained_pairs.push_back({ImageId(i), ImageId(i + step)});
  }
  Contradict(40, 41, results);
  EXPECT_EQ(Checked(results).level, CheckLevel::kGood);
  Contradict(39, 41, results);
  EXPECT_EQ(Checked(results).level, CheckLevel::kDoubtful);
}

TEST(CheckPairs, AnotherDriveIsNoNeighbour) {
  JobResults results = Drive();
  for (uint32_t i = 50; i < 100; ++i) results.manifest.images[i].drive = 1;
  Contradict(49, 50, results);
  EXPECT_EQ(Checked(results).level, CheckLevel::kGood);
}

/// A street of which the second half is of another day, in a model that has images 50 and on so
/// many steps further along than they are.
JobResults TwoDays(double jump_steps) {
  JobResults results = Drive();
  AdjustedModel& model = results.models.emplace_back();
  for (ImageRecord& image : results.manifest.images) {
    const bool is_second = image.id.value >= 50;
    image.drive = is_second ? 1 : 0;
    const double at = image.id.value + (is_second ? jump_steps : 0.0);
    model.images[image.id].cam_from_world =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), Eigen::Vector3d(4.0 * at, 0.0, 0.0));
  }
  std::erase(results.clusters[0].explained_pairs, ImagePair{ImageId(49), ImageId(50)});
  return results;
}

TEST(CheckPairs, WhatStandsBesideAnImageIsItsNeighbourWhateverItsDrive) {
  JobResults results = TwoDays(1.0);
  Contradict(49, 50, results);
  EXPECT_EQ(Checked(results).level, CheckLevel::kDoubtful);
  EXPECT_THAT(Checked(results).sentence, HasSubstr("first 49.jpg and 50.jpg"));
  Contradict(48, 50, results);
  Contradict(49, 51, results);
  EXPECT_EQ(Checked(results).level, CheckLevel::kBad);
}

TEST(CheckPairs, PairsOfTwoDaysAreOutvotedByThoseAroundThem) {
  JobResults results = TwoDays(0.0);
  Contradict(49, 51, results);
  for (const auto& [a, b] : {std::pair(49U, 50U), std::pair(48U, 50U), std::pair(48U, 51U)})
    results.clusters[0].explained_pairs.push_back({ImageId(a), ImageId(b)});
  EXPECT_EQ(Checked(results).level, CheckLevel::kGood);
  EXPECT_THAT(Checked(results).sentence, HasSubstr("but for 1 that"));
}

TEST(CheckPairs, WhatTheModelHasApartMayLookAlike) {
  JobResults results = TwoDays(6.0);
  Contradict(49, 50, results);
  EXPECT_EQ(Checked(results).level, CheckLevel::kGood);
}

/// A street that is driven there and back, in one drive: the ways back are not where the ways there
/// are.
TEST(CheckPairs, TwoPassagesBesideEachOtherAreNeighbours) {
  JobResults results = TwoDays(0.0);
  for (auto& [id, image] : results.models[0].images) {
    results.manifest.images[id.value].drive = 0;
    const bool is_back = id.value >= 50;
    const double along = is_back ? 99.0 - id.value : id.value;
    image.cam_from_world = Rigid3::FromCentre(Eigen::Quaterniond::Identity(),
                                              Eigen::Vector3d(4.0 * along, is_back, 0.0));
  }
  Contradict(20, 79, results);
  EXPECT_EQ(Checked(results).level, CheckLevel::kDoubtful);
  results.clusters[0].contradicted_pairs = {{ImageId(20), ImageId(60)}};
  EXPECT_EQ(Checked(results).level, CheckLevel::kGood);
}

}  // namespace
}  // namespace orbweave
