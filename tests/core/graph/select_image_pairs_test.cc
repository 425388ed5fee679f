// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/select_image_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/graph/pair_options.h"

namespace orbweave {
namespace {

// Images 3 m apart along a street.
ImageManifest DriveAlongStreet(uint32_t num_images, bool with_gnss) {
  ImageManifest manifest;
  for (uint32_t i = 0; i < num_images; ++i) {
    ImageRecord& image = manifest.images.emplace_back();
    image.id = ImageId(i);
    if (with_gnss) image.prior.position_in_enu = Eigen::Vector3d(3.0 * i, 0.0, 0.0);
  }
  return manifest;
}

bool Has(const std::vector<ImagePair>& pairs, uint32_t a, uint32_t b) {
  return std::binary_search(pairs.begin(), pairs.end(), MakePair(ImageId(a), ImageId(b)));
}

void ExpectSortedAndUnique(const std::vector<ImagePair>& pairs) {
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  EXPECT_EQ(std::adjacent_find(pairs.begin(), pairs.end()), pairs.end());
  for (const ImagePair& pair : pairs) EXPECT_LT(pair.a, pair.b);
}

TEST(SelectImagePairs, PairsEveryTwoOfASmallJob) {
  const auto pairs = SelectImagePairs(DriveAlongStreet(11, true), {}, {});
  EXPECT_EQ(pairs.size(), 55U);
  ExpectSortedAndUnique(pairs);
}

TEST(SelectImagePairs, PairsAWindowWithoutGnss) {
  const auto pairs = SelectImagePairs(
      DriveAlongStreet(100, false), {}, {.sequence_window = 4, .exhaustive_below = 0});
  EXPECT_EQ(pairs.size(), 96U * 4U + 3U + 2U + 1U);
  EXPECT_TRUE(Has(pairs, 10, 14));
  EXPECT_FALSE(Has(pairs, 10, 15));
  ExpectSortedAndUnique(pairs);
}

TEST(SelectImagePairs, KeepsDrivesApart) {
  ImageManifest manifest = DriveAlongStreet(6, false);
  for (uint32_t i = 3; i < 6; ++i) manifest.images[i].drive = 1;
  const auto pairs = SelectImagePairs(manifest, {}, {.sequence_window = 1, .exhaustive_below = 0});
  EXPECT_EQ(pairs.size(), 4U);
  EXPECT_FALSE(Has(pairs, 2, 3));
}

/// A table that lacks three rows, between two drives.
TEST(SelectImagePairs, PairsWhatNothingIsKnownOfWithItsNeighboursByName) {
  ImageManifest manifest = DriveAlongStreet(11, true);
  for (uint32_t i = 0; i < 11; ++i) {
    ImageRecord& image = manifest.images[i];
    image.name = "street/" + std::to_string(i) + ".jpg";
    image.drive = i < 4 ? 0 : i < 7 ? 1 : 2;
    if (image.drive == 1) image.prior.position_in_enu.reset();
  }
  const PairOptions options{.sequence_window = 2, .gnss_radius_m = 0.0, .exhaustive_below = 0};
  const auto pairs = SelectImagePairs(manifest, {}, options);
  ExpectSortedAndUnique(pairs);
  EXPECT_TRUE(Has(pairs, 3, 4));
  EXPECT_TRUE(Has(pairs, 3, 5));
  EXPECT_TRUE(Has(pairs, 6, 7));
  EXPECT_FALSE(Has(pairs, 2, 5));
  EXPECT_FALSE(Has(pairs, 3, 7));
  for (uint32_t i = 7; i < 11; ++i) manifest.images[i].name = "other/" + std::to_string(i) + ".jpg";
  EXPECT_FALSE(Has(SelectImagePairs(manifest, {}, options), 6, 7));
}

TEST(SelectImagePairs, PairsNeighboursInTimeRatherThanInNames) {
  ImageManifest manifest = DriveAlongStreet(6, false);
  const double times_s[] = {0.0, 3.0, 1.0, 4.0, 2.0, 5.0};  // in time: 0 2 4 1 3 5
  for (uint32_t i = 0; i < 6; ++i) manifest.images[i].capture_time_s = times_s[i];
  const auto pairs = SelectImagePairs(manifest, {}, {.sequence_window = 1, .exhaustive_below = 0});
  EXPECT_EQ(pairs.size(), 5U);
  EXPECT_TRUE(Has(pairs, 0, 2));
  EXPECT_TRUE(Has(pairs, 1, 4));
  EXPECT_FALSE(Has(pairs, 0, 1));
  ExpectSortedAndUnique(pairs);
}

TEST(SelectImagePairs, FindsTheSamePlaceVisitedTwice) {
  ImageManifest manifest = DriveAlongStreet(100, true);
  manifest.images[90].prior.position_in_enu =
      Eigen::Vector3d(6.0, 2.0, 30.0);  // height is not trusted
  const auto pairs = SelectImagePairs(
      manifest, {}, {.sequence_window = 2, .gnss_radius_m = 5.0, .exhaustive_below = 0});
  EXPECT_TRUE(Has(pairs, 2, 90));
  EXPECT_FALSE(Has(pairs, 20, 90));
  ExpectSortedAndUnique(pairs);
}

TEST(SelectImagePairs, KeepsAPairThatOneSideAloneFindsNear) {
  // Image 3 stands apart: its nearest is 2, but 2 has a nearer neighbour.
  ImageManifest manifest = DriveAlongStreet(4, true);
  manifest.images[3].prior.position_in_enu = Eigen::Vector3d(14.0, 0.0, 0.0);
  const auto pairs = SelectImagePairs(
      manifest, {}, {.sequence_window = 0, .gnss_max_neighbours = 1, .exhaustive_below = 0});
  EXPECT_TRUE(Has(pairs, 2, 3));
}

TEST(SelectImagePairs, CapsNeighboursOfACarThatStands) {
  ImageManifest manifest = DriveAlongStreet(200, true);
  for (ImageRecord& image : manifest.images) image.prior.position_in_enu = Eigen::Vector3d::Zero();
  const auto pairs = SelectImagePairs(
      manifest, {}, {.sequence_window = 0, .gnss_max_neighbours = 5, .exhaustive_below = 0});
  EXPECT_LE(pairs.size(), 200U * 5U);
  EXPECT_GE(pairs.size(), 200U * 5U / 2U);
}

TEST(SelectImagePairs, LooksFurtherWhereTheStreetIsThinlyCovered) {
  // 12 m apart: within 20 m there is one neighbour on either side only.
  ImageManifest manifest = DriveAlongStreet(60, true);
  for (ImageRecord& image : manifest.images)
    image.prior.position_in_enu = Eigen::Vector3d(12.0 * image.id.value, 0.0, 0.0);
  const auto pairs = SelectImagePairs(
      manifest, {}, {.sequence_window = 0, .gnss_min_neighbours = 6, .exhaustive_below = 0});
  EXPECT_TRUE(Has(pairs, 30, 32));
  EXPECT_TRUE(Has(pairs, 30, 33));
  EXPECT_FALSE(Has(pairs, 30, 35));  // 60 m: further than look-alikes are believed
  const auto near = SelectImagePairs(
      manifest, {}, {.sequence_window = 0, .gnss_min_neighbours = 0, .exhaustive_below = 0});
  EXPECT_EQ(near.size(), 59U);
}

TEST(SelectImagePairs, LeavesSequencePairsOfAGnssOutlierAlone) {
  ImageManifest manifest = DriveAlongStreet(60, true);
  manifest.images[30].prior.position_in_enu = Eigen::Vector3d(5000.0, 5000.0, 0.0);
  const auto pairs = SelectImagePairs(manifest, {}, {.sequence_window = 3, .exhaustive_below = 0});
  for (const uint32_t other : {27, 28, 29, 31, 32, 33}) EXPECT_TRUE(Has(pairs, 30, other));
}

TEST(SelectImagePairs, GatesLookAlikesByGnssWhereBothHaveIt) {
  ImageManifest manifest = DriveAlongStreet(100, true);
  manifest.images[70].prior.position_in_enu.reset();
  std::vector<std::vector<ImageId>> similar(100);
  similar[0] = {ImageId(0), ImageId(16), ImageId(17), ImageId(70), ImageId(90)};
  PairOptions options{.sequence_window = 0, .gnss_radius_m = 0.0, .exhaustive_below = 0};
  const auto pairs = SelectImagePairs(manifest, similar, options);
  EXPECT_TRUE(Has(pairs, 0, 16));   // 48 m
  EXPECT_FALSE(Has(pairs, 0, 17));  // 51 m
  EXPECT_TRUE(Has(pairs, 0, 70)) << "an image without GNSS cannot be gated";
  EXPECT_FALSE(Has(pairs, 0, 90));
  EXPECT_EQ(pairs.size(), 2U) << "no image is paired with itself";

  manifest.images[90].prior.horizontal_sigma_m = 100.0;
  EXPECT_TRUE(Has(SelectImagePairs(manifest, similar, options), 0, 90))
      << "the gate widens with the stated sigma";
}

TEST(SelectImagePairs, IsEmptyForLessThanTwoImages) {
  EXPECT_TRUE(SelectImagePairs({}, {}, {}).empty());
  EXPECT_TRUE(SelectImagePairs(DriveAlongStreet(1, true), {}, {}).empty());
}

}  // namespace
}  // namespace orbweave
