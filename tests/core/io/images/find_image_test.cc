// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/find_image.h"

#include <gmock/gmock.h>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

ImageManifest Manifest(const std::vector<std::string>& names) {
  ImageManifest manifest;
  for (const std::string& name : names) {
    manifest.images.push_back(
        {.id = ImageId{static_cast<uint32_t>(manifest.images.size())}, .name = name});
  }
  return manifest;
}

const ImageManifest kImages = Manifest({"day1/00012.jpg",
                                        "day1/00112.jpg",
                                        "day2/00013.jpg",
                                        "day2/roof.jpg",
                                        "roof_old.jpg",
                                        "day1/00013.png"});

uint32_t Found(std::string_view text) {
  const auto found = FindImage(kImages, text);
  EXPECT_TRUE(found.ok()) << found.status();
  return found.ok() ? found->value : 999;
}

TEST(FindImage, TakesTheWholeNameFirst) {
  EXPECT_EQ(Found("day1/00012.jpg"), 0U);
  EXPECT_EQ(FindImage(Manifest({"a/b.jpg", "b.jpg"}), "b.jpg")->value, 1U);
}

TEST(FindImage, TakesWhatOnlyOneNameIsWithoutFolderOrEnding) {
  EXPECT_EQ(Found("00112.jpg"), 1U);
  EXPECT_EQ(Found("roof"), 3U);
  EXPECT_EQ(Found("day2/00013"), 2U);
}

TEST(FindImage, TakesTheNumberThatOnlyOneNameEndsIn) {
  EXPECT_EQ(Found("12"), 0U);
  EXPECT_EQ(Found("0112"), 1U);
}

TEST(FindImage, TakesAnEndingThatOnlyOneNameHas) {
  EXPECT_EQ(Found("13.png"), 5U);
  EXPECT_EQ(Found("_old"), 4U);
}

TEST(FindImage, SaysWhichItCannotTellApart) {
  const absl::Status status = FindImage(kImages, "13").status();
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  EXPECT_THAT(status.ToString(), HasSubstr("day2/00013.jpg, day1/00013.png"));
}

TEST(FindImage, NamesTheNearestWhereThereIsNone) {
  const absl::Status status = FindImage(kImages, "roff_old.jpg").status();
  EXPECT_TRUE(absl::IsNotFound(status));
  EXPECT_THAT(status.ToString(), HasSubstr("did you mean 'roof_old.jpg'"));
  EXPECT_TRUE(absl::IsInvalidArgument(FindImage(kImages, "").status()));
  EXPECT_TRUE(absl::IsNotFound(FindImage({}, "a").status()));
}

TEST(FindImage, SaysWhyAnImageTakesNoPart) {
  ImageManifest manifest = kImages;
  manifest.excluded.push_back({"day3/sky.jpg", "not 2:1: 400x300"});
  EXPECT_THAT(FindImage(manifest, "sky.jpg").status().ToString(), HasSubstr("not 2:1: 400x300"));
}

}  // namespace
}  // namespace orbweave
