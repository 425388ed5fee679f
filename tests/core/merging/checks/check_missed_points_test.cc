// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_missed_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

/// A model of panoramas that see half of what they are asked for.
struct Model {
  ImageManifest manifest{};
  std::map<ImageId, RegisteredImage> images{};
  std::vector<SeenBetween> counts{};

  Model() {
    for (uint32_t i = 0; i < 12; ++i) {
      manifest.images.push_back({.id = ImageId(i), .name = std::to_string(i) + ".jpg"});
      images[ImageId(i)] = {};
      counts.push_back({ImageId(i), 300 + i, 150});
    }
  }
  [[nodiscard]] CrossCheck Check() const { return CheckMissedPoints(counts, images, manifest); }
};

TEST(CheckMissedPoints, IsGoodWhereAllSeeAboutAsMuch) {
  Model model;
  model.counts[3].seen = 30;  // a bus
  const CrossCheck check = model.Check();
  EXPECT_EQ(check.level, CheckLevel::kGood) << check.sentence;
  EXPECT_NEAR(check.value, 30.0 / 303.0, 1e-12);
  EXPECT_TRUE(check.IsWithinLimit());
  EXPECT_THAT(check.sentence, HasSubstr("12 panoramas"));
}

TEST(CheckMissedPoints, NamesWhoSeesHardlyAnything) {
  Model model;
  model.counts[5].seen = 11;
  model.counts[8].seen = 3;
  const CrossCheck check = model.Check();
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_FALSE(check.IsWithinLimit());
  EXPECT_THAT(check.sentence, HasSubstr("2 of 12 panoramas"));
  EXPECT_THAT(check.sentence, HasSubstr("first 8.jpg: 3 of 308 points"));
}

TEST(ImagesThatMissPoints, AreThoseThatTheCheckDoubts) {
  Model model;
  EXPECT_TRUE(ImagesThatMissPoints(model.counts, model.images).empty());
  model.counts[5].seen = 11;
  model.counts[8].seen = 3;
  const std::vector<SeenBetween> missing = ImagesThatMissPoints(model.counts, model.images);
  ASSERT_EQ(missing.size(), 2U);
  EXPECT_EQ(missing[0].image, ImageId(5));
  EXPECT_EQ(missing[1].image, ImageId(8));
  EXPECT_EQ(missing[1].seen, 3U);
}

TEST(CheckMissedPoints, IsNoneTheBetterForAllOthersSeeingAsLittle) {
  Model model;
  for (SeenBetween& count : model.counts) count.seen = 0;
  EXPECT_EQ(model.Check().level, CheckLevel::kDoubtful);
  EXPECT_THAT(model.Check().sentence, HasSubstr("12 of 12 panoramas"));
}

/// What several subproblems know of one panorama counts together.
TEST(CheckMissedPoints, AddsWhatSubproblemsKnow) {
  Model model;
  model.counts[8] = {ImageId(8), 40, 0};
  EXPECT_EQ(model.Check().level, CheckLevel::kGood) << "too few";
  model.counts.push_back({ImageId(8), 40, 2});
  EXPECT_EQ(model.Check().level, CheckLevel::kDoubtful);
  model.counts.push_back({ImageId(8), 40, 30});
  EXPECT_EQ(model.Check().level, CheckLevel::kGood);
}

TEST(CheckMissedPoints, AsksOnlyForWhatIsInTheModel) {
  Model model;
  model.counts[8].seen = 0;
  model.images.at(ImageId(8)).loose = true;
  EXPECT_EQ(model.Check().level, CheckLevel::kGood);
  model.images.erase(ImageId(8));
  EXPECT_EQ(model.Check().level, CheckLevel::kGood);
  EXPECT_THAT(model.Check().sentence, HasSubstr("11 panoramas"));
}

TEST(CheckMissedPoints, SaysSoWhereNobodyIsAsked) {
  Model model;
  model.counts.clear();
  const CrossCheck check = model.Check();
  EXPECT_EQ(check.level, CheckLevel::kGood);
  EXPECT_EQ(check.limit, 0.0);
  EXPECT_THAT(check.sentence, HasSubstr("no panorama stands between"));
}

}  // namespace
}  // namespace orbweave
