// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/build_tracks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/base/random.h"

namespace orbweave {
namespace {

using testing::ElementsAre;

TwoViewGeometry Pair(uint32_t a, uint32_t b, std::vector<FeatureMatch> inliers) {
  return {.pair = {ImageId(a), ImageId(b)},
          .kind = TwoViewKind::kGeneral,
          .inliers = std::move(inliers)};
}

// Matches of points that every image sees under its own feature number.
std::vector<TwoViewGeometry> ConsistentPairs(uint32_t num_images, uint32_t num_points) {
  const auto feature = [&](uint32_t image, uint32_t point) {
    return (point * 7 + image) % num_points;
  };
  std::vector<TwoViewGeometry> pairs;
  for (uint32_t a = 0; a + 1 < num_images; ++a) {
    std::vector<FeatureMatch> matches;
    for (uint32_t p = 0; p < num_points; ++p) matches.push_back({feature(a, p), feature(a + 1, p)});
    std::sort(matches.begin(), matches.end());
    pairs.push_back(Pair(a, a + 1, std::move(matches)));
  }
  return pairs;
}

TEST(BuildTracks, FollowsAFeatureThroughAChainOfImages) {
  const BuiltTracks built = BuildTracks(std::vector{Pair(0, 1, {{4, 2}}), Pair(1, 7, {{2, 9}})});
  ASSERT_EQ(built.tracks.size(), 1U);
  EXPECT_THAT(
      built.tracks[0].features,
      ElementsAre(FeatureRef{ImageId(0), 4}, FeatureRef{ImageId(1), 2}, FeatureRef{ImageId(7), 9}));
  EXPECT_EQ(built.num_conflicting, 0U);
}

TEST(BuildTracks, FindsEveryPointOnceWhenMatchesAreRight) {
  constexpr uint32_t kPoints = 50;
  const BuiltTracks built = BuildTracks(ConsistentPairs(6, kPoints));
  ASSERT_EQ(built.tracks.size(), kPoints);
  for (const FeatureTrack& track : built.tracks) EXPECT_EQ(track.features.size(), 6U);
}

TEST(BuildTracks, TrustsTheStrongerPairInAConflict) {
  // Image 0's features 1 and 2 meet in image 2 through a wrong match of the weaker pair (0,2).
  const std::vector<TwoViewGeometry> pairs = {
      Pair(0, 1, {{1, 1}, {2, 2}, {3, 3}}), Pair(0, 2, {{2, 1}}), Pair(1, 2, {{1, 1}, {3, 3}})};
  const BuiltTracks built = BuildTracks(pairs);
  EXPECT_EQ(built.num_conflicting, 1U);
  ASSERT_EQ(built.tracks.size(), 3U);
  EXPECT_THAT(
      built.tracks[0].features,
      ElementsAre(FeatureRef{ImageId(0), 1}, FeatureRef{ImageId(1), 1}, FeatureRef{ImageId(2), 1}));
  EXPECT_THAT(built.tracks[1].features,
              ElementsAre(FeatureRef{ImageId(0), 2}, FeatureRef{ImageId(1), 2}));
}

TEST(BuildTracks, HoldsOneFeaturePerImageWhateverTheMatches) {
  Random random(5);
  std::vector<TwoViewGeometry> pairs;
  for (uint32_t a = 0; a < 8; ++a) {
    for (uint32_t b = a + 1; b < 8; ++b) {
      std::vector<FeatureMatch> matches;
      for (uint32_t i = 0; i < 30; ++i) matches.push_back({random.Index(40), random.Index(40)});
      pairs.push_back(Pair(a, b, std::move(matches)));
    }
  }
  const BuiltTracks built = BuildTracks(pairs);
  EXPECT_GT(built.num_conflicting, 0U);
  std::set<FeatureRef> seen;
  for (const FeatureTrack& track : built.tracks) {
    EXPECT_GE(track.features.size(), 2U);
    EXPECT_TRUE(std::is_sorted(track.features.begin(), track.features.end()));
    for (size_t i = 0; i < track.features.size(); ++i) {
      EXPECT_TRUE(seen.insert(track.features[i]).second) << "a feature in two tracks";
      if (i > 0) {
        EXPECT_NE(track.features[i].image, track.features[i - 1].image);
      }
    }
  }
}

TEST(BuildTracks, DoesNotDependOnTheOrderOfThePairs) {
  std::vector<TwoViewGeometry> pairs = ConsistentPairs(6, 20);
  pairs.push_back(Pair(0, 3, {{1, 5}, {2, 9}}));
  const BuiltTracks forward = BuildTracks(pairs);
  std::reverse(pairs.begin(), pairs.end());
  const BuiltTracks backward = BuildTracks(pairs);
  ASSERT_EQ(forward.tracks.size(), backward.tracks.size());
  for (size_t i = 0; i < forward.tracks.size(); ++i) {
    EXPECT_EQ(forward.tracks[i].features, backward.tracks[i].features);
  }
}

TEST(BuildTracks, IsEmptyWithoutMatches) {
  EXPECT_TRUE(BuildTracks({}).tracks.empty());
  EXPECT_TRUE(BuildTracks(std::vector{Pair(0, 1, {})}).tracks.empty());
}

}  // namespace
}  // namespace orbweave
