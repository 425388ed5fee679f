// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/growing_nearest.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"
#include "core/features/find_nearest_two.h"
#include "tests/core/features/squared_distance.h"

namespace orbweave {
namespace {

Features RandomFeatures(uint64_t seed, int count) {
  Random random(seed);
  Features features{.camera = {.width_px = 2048, .height_px = 1024}};
  for (int i = 0; i < count; ++i) {
    features.keypoints.push_back({.x_px = static_cast<float>(random.Uniform(0.0, 2048.0)),
                                  .y_px = static_cast<float>(random.Uniform(0.0, 1024.0)),
                                  .scale_px = static_cast<float>(1 + random.Index(40))});
    for (int k = 0; k < kDescriptorSize; ++k)
      features.descriptors.push_back(static_cast<uint8_t>(random.Index(90)));
  }
  return features;
}

/// Of the features `among` of b.
NearestTwo NearestOf(const PairSide& a,
                     FeatureIndex of,
                     const PairSide& b,
                     std::span<const FeatureIndex> among) {
  NearestTwo nearest;
  for (const FeatureIndex i : among) {
    const int32_t distance =
        testing::SquaredDistance(a.features.Descriptor(of), b.features.Descriptor(i));
    nearest = MergeNearest(nearest, {distance, kNoDistance, i});
  }
  return nearest;
}

TEST(PairSide, OrdersFeaturesByScaleAndThenByIndex) {
  const PairSide side(RandomFeatures(1, 300));
  for (size_t i = 1; i < side.by_scale.size(); ++i) {
    const float before = side.features.keypoints[side.by_scale[i - 1]].scale_px;
    const float after = side.features.keypoints[side.by_scale[i]].scale_px;
    EXPECT_TRUE(before > after || (before == after && side.by_scale[i - 1] < side.by_scale[i]));
  }
  EXPECT_TRUE(std::equal(side.descriptors_by_scale.begin(),
                         side.descriptors_by_scale.begin() + kDescriptorSize,
                         side.features.Descriptor(side.by_scale[0])));
}

TEST(GrowingNearest, KnowsTheNearestOfTheLargestAfterEveryStep) {
  const PairSide a(RandomFeatures(2, 211));
  const PairSide b(RandomFeatures(3, 160));
  GrowingNearest growing(a, b);
  for (const size_t count : {17U, 18U, 100U, 180U, 400U}) {
    growing.GrowTo(count);
    EXPECT_EQ(growing.HasAll(), count >= 211);
    const NearestTwoBothWays nearest = growing.Nearest();
    const std::span<const FeatureIndex> of_a(a.by_scale.data(), std::min<size_t>(count, 211));
    const std::span<const FeatureIndex> of_b(b.by_scale.data(), std::min<size_t>(count, 160));
    for (const FeatureIndex i : of_a) EXPECT_EQ(nearest.of_a[i], NearestOf(a, i, b, of_b));
    for (const FeatureIndex i : of_b) EXPECT_EQ(nearest.of_b[i], NearestOf(b, i, a, of_a));
    for (size_t k = of_a.size(); k < a.by_scale.size(); ++k)
      EXPECT_EQ(nearest.of_a[a.by_scale[k]].best, kNoDistance);
  }
}

TEST(GrowingNearest, EndsWithWhatComparingAllAtOnceFinds) {
  const PairSide a(RandomFeatures(4, 500));
  const PairSide b(RandomFeatures(5, 333));
  GrowingNearest growing(a, b);
  for (const size_t count : {40U, 41U, 350U, 500U}) growing.GrowTo(count);
  const NearestTwoBothWays all = FindNearestTwo(a.features.descriptors, b.features.descriptors);
  EXPECT_EQ(growing.Nearest().of_a, all.of_a);
  EXPECT_EQ(growing.Nearest().of_b, all.of_b);
}

TEST(GrowingNearest, ComparesNothingWithASideThatHasNothing) {
  const PairSide a(RandomFeatures(6, 10));
  const PairSide b(RandomFeatures(7, 0));
  GrowingNearest growing(a, b);
  growing.GrowTo(100);
  EXPECT_TRUE(growing.HasAll());
  EXPECT_EQ(growing.Nearest().of_a[0].best, kNoDistance);
}

}  // namespace
}  // namespace orbweave
