// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/list_pair_candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "core/graph/select_image_pairs.h"

namespace orbweave {
namespace {

using Pairs = std::vector<ImagePair>;

/// Two passes of a street in one drive, images 3 m apart: image `n - 1 - i` is where image i is.
ImageManifest ThereAndBack(uint32_t num_images, bool with_gnss) {
  ImageManifest manifest;
  for (uint32_t i = 0; i < num_images; ++i) {
    ImageRecord& image = manifest.images.emplace_back();
    image.id = ImageId(i);
    const uint32_t place = std::min(i, num_images - 1 - i);
    if (with_gnss) image.prior.position_in_enu = Eigen::Vector3d(3.0 * place, 0.0, 0.0);
  }
  return manifest;
}

/// Every image looks most like those that follow it by `step`, again and again.
std::vector<std::vector<ImageId>> LookAlikes(uint32_t num_images, uint32_t step, uint32_t count) {
  std::vector<std::vector<ImageId>> similar(num_images);
  for (uint32_t i = 0; i < num_images; ++i) {
    for (uint32_t k = 1; k <= count; ++k)
      similar[i].push_back(ImageId((i + k * step) % num_images));
  }
  return similar;
}

bool Has(const Pairs& pairs, uint32_t a, uint32_t b) {
  return std::ranges::binary_search(pairs, MakePair(ImageId(a), ImageId(b)));
}

bool AreApart(const Pairs& some, const Pairs& others) {
  Pairs common;
  std::ranges::set_intersection(some, others, std::back_inserter(common));
  return common.empty();
}

TEST(ListPairCandidates, DividesWhatIsSelectedAndAddsAReserve) {
  const ImageManifest manifest = ThereAndBack(100, true);
  const PairOptions options;
  const PairCandidates candidates = ListPairCandidates(manifest, {}, 10, options);
  Pairs both;
  std::ranges::merge(candidates.first, candidates.second, std::back_inserter(both));
  EXPECT_EQ(both, SelectImagePairs(manifest, {}, options));
  EXPECT_LT(candidates.first.size(), candidates.second.size());
  EXPECT_TRUE(AreApart(candidates.first, candidates.second));
  EXPECT_TRUE(AreApart(both, candidates.reserve));
  EXPECT_TRUE(Has(candidates.reserve, 3, 3 + 2 * 10)) << "a window twice as wide";
  EXPECT_FALSE(Has(candidates.reserve, 3, 4 + 2 * 10));
}

TEST(ListPairCandidates, PutsTheNearestOfEveryImageFirst) {
  const PairOptions options{.first_neighbours = 3};
  const PairCandidates candidates = ListPairCandidates(ThereAndBack(100, true), {}, 10, options);
  for (uint32_t i = 0; i + 3 < 100; ++i) {
    EXPECT_TRUE(Has(candidates.first, i, i + 1));
    EXPECT_TRUE(Has(candidates.first, i, i + 3));
  }
  EXPECT_TRUE(Has(candidates.first, 20, 79)) << "where the other pass is";
  EXPECT_TRUE(Has(candidates.second, 20, 24));
}

TEST(ListPairCandidates, ListsLookAlikesByRankWhereGnssIsSilent) {
  const PairOptions options{.first_neighbours = 2};
  const auto similar = LookAlikes(200, 25, 6);
  const PairCandidates candidates =
      ListPairCandidates(ThereAndBack(200, false), similar, 3, options);
  EXPECT_TRUE(Has(candidates.first, 0, 50));
  EXPECT_TRUE(Has(candidates.second, 0, 75));
  EXPECT_TRUE(Has(candidates.reserve, 0, 100));
}

TEST(ListPairCandidates, KeepsLookAlikesOfKnownPlacesInReserve) {
  const auto similar = LookAlikes(100, 15, 1);
  const PairCandidates candidates =
      ListPairCandidates(ThereAndBack(100, true), similar, 10, {.gnss_radius_m = 1.0});
  EXPECT_TRUE(Has(candidates.reserve, 10, 25)) << "45 m apart";
  EXPECT_FALSE(Has(candidates.first, 10, 25));
  EXPECT_FALSE(Has(candidates.second, 10, 25));
}

TEST(ListPairCandidates, MatchesAllPairsOfSmallJobsAtOnce) {
  const PairCandidates candidates = ListPairCandidates(ThereAndBack(12, true), {}, 10, {});
  EXPECT_EQ(candidates.first.size(), 66U);
  EXPECT_TRUE(candidates.second.empty());
  EXPECT_TRUE(candidates.reserve.empty());
}

TEST(ListPairCandidates, MatchesAllAtOnceWhereNoneAreToBeFirst) {
  const ImageManifest manifest = ThereAndBack(100, true);
  const PairOptions options{.first_neighbours = 0};
  const PairCandidates candidates = ListPairCandidates(manifest, {}, 10, options);
  EXPECT_EQ(candidates.first, SelectImagePairs(manifest, {}, options));
  EXPECT_TRUE(candidates.second.empty());
  EXPECT_TRUE(candidates.reserve.empty());
}

TEST(ListPairCandidates, AreNoneOfLessThanTwoImages) {
  for (const uint32_t images : {0U, 1U}) {
    const PairCandidates candidates =
        ListPairCandidates(ThereAndBack(images, true), {}, 10, {.exhaustive_below = 0});
    EXPECT_TRUE(candidates.first.empty());
    EXPECT_TRUE(candidates.second.empty());
    EXPECT_TRUE(candidates.reserve.empty());
  }
}

}  // namespace
}  // namespace orbweave
