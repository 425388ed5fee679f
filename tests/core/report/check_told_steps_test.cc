// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_told_steps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

constexpr uint32_t kImages = 20;

/// A model of a drive; of 400 rays across each step 150 tell how long it is.
JobResults Drive() {
  JobResults results;
  results.clusters.emplace_back();
  results.models.emplace_back();
  for (uint32_t a = 0; a < kImages; ++a) {
    ImageRecord& image = results.manifest.images.emplace_back();
    image.id = ImageId(a);
    image.name = std::to_string(a) + ".jpg";
    results.models[0].images[image.id] = {};
    if (a + 1 == kImages) continue;
    results.clusters[0].gap_lengths.push_back(
        {.between = {ImageId(a), ImageId(a + 1)}, .rays = 400, .telling_rays = 150});
  }
  return results;
}

TEST(CheckToldSteps, IsGoodWhereRaysTell) {
  EXPECT_EQ(CheckToldSteps(Drive()).level, CheckLevel::kGood);
  EXPECT_THAT(CheckToldSteps(Drive()).sentence, HasSubstr("19 steps"));
  EXPECT_EQ(CheckToldSteps(Drive()).value, 150.0);
  EXPECT_EQ(CheckToldSteps({}).level, CheckLevel::kGood);
}

TEST(CheckToldSteps, FewRaysAreDoubtfulAndNamed) {
  JobResults results = Drive();
  results.clusters[0].gap_lengths[7].telling_rays = 22;
  results.clusters[0].gap_lengths[12].telling_rays = 13;
  const CrossCheck check = CheckToldSteps(results);
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_EQ(check.value, 13.0);
  EXPECT_THAT(check.sentence, HasSubstr("2 of 19 steps"));
  EXPECT_THAT(check.sentence, HasSubstr("between 12.jpg and 13.jpg: 13 of its 400 rays"));
}

TEST(CheckToldSteps, GnssMayTellInstead) {
  JobResults results = Drive();
  results.clusters[0].gap_lengths[7].telling_rays = 3;
  results.clusters[0].gap_lengths[7].is_borne_out = true;
  EXPECT_EQ(CheckToldSteps(results).level, CheckLevel::kGood);
}

TEST(CheckToldSteps, NarrowStepsWhoseRaysHardlyMeetAreNotAsked) {
  JobResults results = Drive();
  results.clusters[0].gap_lengths[7].rays = 20;
  results.clusters[0].gap_lengths[7].telling_rays = 3;
  EXPECT_EQ(CheckToldSteps(results).level, CheckLevel::kGood);
}

TEST(CheckToldSteps, AStepBetweenModelsIsNone) {
  JobResults results = Drive();
  results.clusters[0].gap_lengths[7].telling_rays = 3;
  results.models.emplace_back();
  results.models[1].images[ImageId(8)] = results.models[0].images[ImageId(8)];
  results.models[0].images.erase(ImageId(8));
  EXPECT_EQ(CheckToldSteps(results).level, CheckLevel::kGood);
}

TEST(CheckToldSteps, TheClusterThatTellsMoreCounts) {
  JobResults results = Drive();
  results.clusters.push_back(results.clusters[0]);
  results.clusters[0].gap_lengths[7].telling_rays = 3;
  EXPECT_EQ(CheckToldSteps(results).level, CheckLevel::kGood);
  results.clusters[1].gap_lengths[7].telling_rays = 4;
  EXPECT_EQ(CheckToldSteps(results).level, CheckLevel::kDoubtful);
}

}  // namespace
}  // namespace orbweave
