// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/find_common_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

using ::testing::ElementsAre;

Track TrackOf(std::vector<FeatureRef> refs) {
  Track track;
  for (const FeatureRef& ref : refs) track.observations.push_back({.ref = ref});
  return track;
}

Reconstruction Model(std::vector<uint32_t> images, std::vector<Track> tracks) {
  Reconstruction model{.tracks = std::move(tracks)};
  for (const uint32_t image : images) model.images[ImageId(image)] = {};
  return model;
}

CommonView ViewOf(const Reconstruction& a, const Reconstruction& b) {
  return FindCommonView(a, IndexFeatures(a), b, IndexFeatures(b));
}

TEST(FindCommonView, FindsSharedImagesAndTracks) {
  const Reconstruction a = Model(
      {0, 1, 2},
      {TrackOf({{ImageId(0), 5}, {ImageId(1), 5}}), TrackOf({{ImageId(1), 8}, {ImageId(2), 8}})});
  const Reconstruction b = Model(
      {1, 2, 3},
      {TrackOf({{ImageId(1), 8}, {ImageId(3), 1}}), TrackOf({{ImageId(2), 9}, {ImageId(3), 2}})});
  const CommonView view = ViewOf(a, b);
  EXPECT_THAT(view.images, ElementsAre(ImageId(1), ImageId(2)));
  ASSERT_EQ(view.tracks.size(), 1U);
  EXPECT_EQ(view.tracks[0].track_a, 1U);
  EXPECT_EQ(view.tracks[0].track_b, 0U);
}

TEST(FindCommonView, LetsTheMajorityOfFeaturesPairTracks) {
  const Reconstruction a =
      Model({0, 1, 2}, {TrackOf({{ImageId(0), 1}, {ImageId(1), 1}, {ImageId(2), 1}})});
  const Reconstruction b = Model(
      {0, 1, 2},
      {TrackOf({{ImageId(0), 1}, {ImageId(1), 7}}), TrackOf({{ImageId(1), 1}, {ImageId(2), 1}})});
  const CommonView view = ViewOf(a, b);
  ASSERT_EQ(view.tracks.size(), 1U);
  EXPECT_EQ(view.tracks[0].track_b, 1U);
}

TEST(FindCommonView, IsEmptyForStrangers) {
  const CommonView view = ViewOf(Model({0, 1}, {TrackOf({{ImageId(0), 1}, {ImageId(1), 1}})}),
                                 Model({2, 3}, {TrackOf({{ImageId(2), 1}, {ImageId(3), 1}})}));
  EXPECT_TRUE(view.images.empty());
  EXPECT_TRUE(view.tracks.empty());
}

TEST(FeaturesOf, CutsTheIndexByImage) {
  const Reconstruction model = Model(
      {0, 1},
      {TrackOf({{ImageId(0), 3}, {ImageId(1), 4}}), TrackOf({{ImageId(0), 1}, {ImageId(1), 2}})});
  const auto index = IndexFeatures(model);
  const auto of_1 = FeaturesOf(index, ImageId(1));
  ASSERT_EQ(of_1.size(), 2U);
  EXPECT_EQ(of_1[0].ref.feature, 2U);
  EXPECT_EQ(of_1[0].track, 1U);
  EXPECT_TRUE(FeaturesOf(index, ImageId(7)).empty());
}

}  // namespace
}  // namespace orbweave
