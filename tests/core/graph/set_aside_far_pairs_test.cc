// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/set_aside_far_pairs.h"

#include <gmock/gmock.h>

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Images 10 m apart along a street, with positions as good as 1 m.
ImageManifest Street(uint32_t num_images) {
  ImageManifest manifest;
  for (uint32_t i = 0; i < num_images; ++i) {
    ImageRecord& image = manifest.images.emplace_back();
    image.id = ImageId(i);
    image.name = std::to_string(i) + ".jpg";
    image.prior.position_in_enu = Eigen::Vector3d(10.0 * i, 0.0, 0.0);
    image.prior.horizontal_sigma_m = 1.0;
  }
  return manifest;
}

std::vector<TwoViewGeometry> Pairs(std::initializer_list<std::pair<uint32_t, uint32_t>> ids) {
  std::vector<TwoViewGeometry> pairs;
  for (const auto& [a, b] : ids) pairs.emplace_back().pair = {ImageId(a), ImageId(b)};
  return pairs;
}

std::vector<std::pair<uint32_t, uint32_t>> Ids(const std::vector<TwoViewGeometry>& pairs) {
  std::vector<std::pair<uint32_t, uint32_t>> ids;
  for (const TwoViewGeometry& pair : pairs) ids.emplace_back(pair.pair.a.value, pair.pair.b.value);
  return ids;
}

constexpr PairOptions kNoWindow{.sequence_window = 0};

TEST(SetAsideFarPairs, TakesOutWhatGnssPutsApart) {
  ImageManifest manifest = Street(100);
  auto pairs = Pairs({{0, 5}, {0, 6}, {0, 90}, {3, 4}, {10, 99}, {20, 80}});
  SetAsideFarPairs(kNoWindow, manifest, pairs);
  EXPECT_THAT(Ids(pairs), ElementsAre(std::pair(0U, 5U), std::pair(3U, 4U)));
  ASSERT_EQ(manifest.warnings.size(), 1U);
  EXPECT_THAT(manifest.warnings[0], HasSubstr("4 pairs of images"));
  EXPECT_THAT(manifest.warnings[0], HasSubstr("0.jpg and 6.jpg, 0.jpg and 90.jpg"));
  EXPECT_THAT(manifest.warnings[0], HasSubstr(", ..."));
}

TEST(SetAsideFarPairs, KeepsPairsOfWhichOnePositionIsNotKnown) {
  ImageManifest manifest = Street(100);
  manifest.images[90].prior.position_in_enu.reset();
  auto pairs = Pairs({{0, 90}});
  SetAsideFarPairs(kNoWindow, manifest, pairs);
  EXPECT_EQ(pairs.size(), 1U);
  EXPECT_THAT(manifest.warnings, IsEmpty());
}

TEST(SetAsideFarPairs, OpensTheGateAsFarAsPositionsScatter) {
  ImageManifest manifest = Street(100);
  for (ImageRecord& image : manifest.images) image.prior.horizontal_sigma_m = 100.0;
  auto pairs = Pairs({{0, 60}, {0, 61}});
  SetAsideFarPairs(kNoWindow, manifest, pairs);
  EXPECT_THAT(Ids(pairs), ElementsAre(std::pair(0U, 60U)));
}

TEST(SetAsideFarPairs, LeavesTheChainAloneWhateverOnePositionSays) {
  ImageManifest manifest = Street(100);
  manifest.images[40].prior.position_in_enu = Eigen::Vector3d(5000.0, 0.0, 0.0);
  auto pairs = Pairs({{39, 40}, {40, 41}, {40, 60}});
  SetAsideFarPairs({}, manifest, pairs);
  EXPECT_THAT(Ids(pairs), ElementsAre(std::pair(39U, 40U), std::pair(40U, 41U)));
}

TEST(SetAsideFarPairs, FollowsTheChainInTimeAndNotIntoAnotherDrive) {
  ImageManifest manifest = Street(100);
  for (uint32_t i = 0; i < 100; ++i)
    manifest.images[i].capture_time_s = i == 90 ? 0.5 : static_cast<double>(i);
  manifest.images[99].drive = 1;
  auto pairs = Pairs({{1, 90}, {92, 99}});
  manifest.images[92].prior.position_in_enu = Eigen::Vector3d(0.0, 0.0, 0.0);
  SetAsideFarPairs({}, manifest, pairs);
  EXPECT_THAT(Ids(pairs), ElementsAre(std::pair(1U, 90U)));
}

}  // namespace
}  // namespace orbweave
