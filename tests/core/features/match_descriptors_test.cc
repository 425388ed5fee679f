// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/match_descriptors.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/features/accept_matches.h"
#include "core/features/find_nearest_two.h"

namespace orbweave {
namespace {

/// A unit descriptor (length 512) at an angle between two axes of its space.
std::vector<uint8_t> Direction(double angle_rad, size_t axis = 0) {
  // Eight equal entries per axis keep each below 256.
  std::vector<uint8_t> descriptor(kDescriptorSize, 0);
  for (size_t k = 0; k < 8; ++k) {
    descriptor[16 * axis + k] =
        static_cast<uint8_t>(std::lround(std::cos(angle_rad) * 512.0 / std::sqrt(8.0)));
    descriptor[16 * axis + 8 + k] =
        static_cast<uint8_t>(std::lround(std::sin(angle_rad) * 512.0 / std::sqrt(8.0)));
  }
  return descriptor;
}

Features Described(const std::vector<std::vector<uint8_t>>& descriptors) {
  Features features;
  features.camera = {.width_px = 1000, .height_px = 500};
  for (const auto& descriptor : descriptors) {
    features.keypoints.emplace_back();
    features.descriptors.insert(features.descriptors.end(), descriptor.begin(), descriptor.end());
  }
  return features;
}

Features RandomFeatures(int count, uint64_t seed) {
  Random random(seed);
  std::vector<std::vector<uint8_t>> descriptors;
  for (int i = 0; i < count; ++i) {
    descriptors.push_back(Direction(random.Uniform(0.0, 1.57), random.Index(8)));
  }
  return Described(descriptors);
}

TEST(MatchDescriptors, FindsEqualDescriptors) {
  const Features a = Described({Direction(0.0), Direction(0.8), Direction(1.5)});
  const Features b = Described({Direction(1.5), Direction(0.0), Direction(0.8)});
  EXPECT_EQ(MatchDescriptors(a, b, {}), (std::vector<FeatureMatch>{{0, 1}, {1, 2}, {2, 0}}));
}

TEST(MatchDescriptors, RejectsAmbiguousNeighbours) {
  const Features a = Described({Direction(0.4)});
  const Features b = Described({Direction(0.5), Direction(0.2)});  // 0.1 and 0.2 away: ratio 0.5
  EXPECT_EQ(MatchDescriptors(a, b, {.max_ratio = 0.6}).size(), 1U);
  EXPECT_EQ(MatchDescriptors(a, b, {.max_ratio = 0.4}).size(), 0U);
}

TEST(MatchDescriptors, RejectsDistantNeighbours) {
  const Features a = Described({Direction(0.0)});
  const Features b = Described({Direction(0.5)});  // chord 2 sin(0.25) = 0.495
  EXPECT_EQ(MatchDescriptors(a, b, {.max_distance = 0.52}).size(), 1U);
  EXPECT_EQ(MatchDescriptors(a, b, {.max_distance = 0.47}).size(), 0U);
}

TEST(MatchDescriptors, CrossCheckMakesMatchesOneToOne) {
  const Features a = Described({Direction(0.0), Direction(0.3)});
  const Features b = Described({Direction(0.02)});
  EXPECT_EQ(MatchDescriptors(a, b, {.cross_check = false}).size(), 2U);
  EXPECT_EQ(MatchDescriptors(a, b, {.cross_check = true}), (std::vector<FeatureMatch>{{0, 0}}));
}

TEST(MatchDescriptors, IsSymmetricWithCrossCheck) {
  const Features a = RandomFeatures(150, 1);
  const Features b = RandomFeatures(170, 2);
  const std::vector<FeatureMatch> ab = MatchDescriptors(a, b, {});
  std::vector<FeatureMatch> ba;
  for (const FeatureMatch& match : MatchDescriptors(b, a, {})) ba.push_back({match.b, match.a});
  std::sort(ba.begin(), ba.end());
  EXPECT_GT(ab.size(), 5U);
  EXPECT_EQ(ab, ba);
}

TEST(RateMatches, PutsTheLeastAmbiguousFirst) {
  // 0.2, 0.1 and 0.3 of the way to the second nearest, of either side.
  const Features a = Described({Direction(0.3), Direction(0.9), Direction(1.35)});
  const Features b = Described({Direction(0.42), Direction(0.96), Direction(1.365)});
  const NearestTwoBothWays nearest = FindNearestTwo(a.descriptors, b.descriptors);
  const std::vector<RatedMatch> rated = RateMatches(AcceptNearest(nearest, {}), nearest);
  ASSERT_EQ(rated.size(), 3U);
  EXPECT_EQ(BestFirst(rated), (std::vector<FeatureMatch>{{2, 2}, {1, 1}, {0, 0}}));
  // Exchanging the panoramas exchanges the matches and leaves their order.
  const NearestTwoBothWays turned{.of_a = nearest.of_b, .of_b = nearest.of_a};
  const std::vector<RatedMatch> exchanged = RateMatches(AcceptNearest(turned, {}), turned);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(exchanged[i].squared_ratio, rated[i].squared_ratio);
}

TEST(RateMatches, KnowsNoAmbiguityWithoutASecond) {
  const Features one = Described({Direction(0.3)});
  const NearestTwoBothWays nearest = FindNearestTwo(one.descriptors, one.descriptors);
  const std::vector<RatedMatch> rated = RateMatches(AcceptNearest(nearest, {}), nearest);
  ASSERT_EQ(rated.size(), 1U);
  EXPECT_EQ(rated.front().squared_ratio, 0.0);
}

TEST(MatchDescriptors, ReturnsNothingWithoutDescriptors) {
  const Features some = RandomFeatures(5, 3);
  Features without;
  without.keypoints.resize(5);
  EXPECT_TRUE(MatchDescriptors(some, without, {}).empty());
  EXPECT_TRUE(MatchDescriptors(without, some, {}).empty());
  EXPECT_TRUE(MatchDescriptors({}, {}, {}).empty());
}

}  // namespace
}  // namespace orbweave
