// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/captures_along.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace orbweave {
namespace {

using ::testing::ElementsAre;

std::vector<uint32_t> CapturesOf(const std::vector<std::string>& names) {
  ImageManifest manifest;
  std::vector<ImageId> sequence;
  for (const std::string& name : names) {
    sequence.emplace_back(static_cast<uint32_t>(manifest.images.size()));
    manifest.images.push_back({.id = sequence.back(), .name = name});
  }
  return CapturesAlong(manifest, sequence);
}

TEST(CapturesAlong, CountThoseThatWereTakenOut) {
  EXPECT_THAT(CapturesOf({"R0010035.JPG", "R0010036.JPG", "R0010038.JPG", "R0010039.JPG"}),
              ElementsAre(0, 1, 3, 4));
}

TEST(CapturesAlong, CountByTheLastNumberOfANameInItsFolder) {
  EXPECT_THAT(CapturesOf({"1.5/a7_9_hdr.v2", "1.5/a7_10_hdr.v2", "1.5/a7_12_hdr.v2"}),
              ElementsAre(0, 1, 3));
  EXPECT_THAT(CapturesOf({"1.5/a9_hdr", "1.5/a10_hdr", "1.5/a12_hdr"}), ElementsAre(0, 1, 3));
}

TEST(CapturesAlong, CountFramesOfAVideoOfWhichEachTenthWasKept) {
  EXPECT_THAT(CapturesOf({"f_0010.png", "f_0020.png", "f_0030.png", "f_0060.png", "f_0065.png"}),
              ElementsAre(0, 1, 2, 5, 6));
}

TEST(CapturesAlong, ACameraThatBeginsAnewGoesOn) {
  EXPECT_THAT(CapturesOf({"DJI_0998.jpg", "DJI_0999.jpg", "DJI_0001.jpg", "DJI_0002.jpg"}),
              ElementsAre(0, 1, 2, 3));
}

TEST(CapturesAlong, AreOneEachWhereNumbersCountNothing) {
  EXPECT_THAT(CapturesOf({"church.jpg", "market.jpg", "town_hall.jpg"}), ElementsAre(0, 1, 2));
  EXPECT_THAT(CapturesOf({"c1", "b40", "a300", "f301"}), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(CapturesOf({"9999999999999999999999", "99999999999999999999998", "x"}),
              ElementsAre(0, 1, 2));
  EXPECT_THAT(CapturesOf({"7", "7", "7"}), ElementsAre(0, 1, 2));
}

TEST(CapturesAlong, SoManyAsNobodyAsksFor) {
  EXPECT_THAT(CapturesOf({"1", "2", "3", "4", "900000000000000000"}),
              ElementsAre(0, 1, 2, 3, 1003));
}

TEST(CapturesAlong, AreNoneWithoutImages) { EXPECT_TRUE(CapturesOf({}).empty()); }

}  // namespace
}  // namespace orbweave
