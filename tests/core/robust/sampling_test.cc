// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/robust/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

namespace orbweave {
namespace {

TEST(DrawSample, GivesDifferentNumbersInRange) {
  Random random(1);
  std::array<uint32_t, 5> sample{};
  for (int trial = 0; trial < 1000; ++trial) {
    DrawSample(random, 6, sample);
    EXPECT_EQ(std::set<uint32_t>(sample.begin(), sample.end()).size(), 5U);
    EXPECT_LT(*std::max_element(sample.begin(), sample.end()), 6U);
  }
}

TEST(DrawSample, DrawsAllNumbersAlike) {
  Random random(2);
  std::array<uint32_t, 3> sample{};
  std::array<int, 10> counts{};
  for (int trial = 0; trial < 10000; ++trial) {
    DrawSample(random, 10, sample);
    for (const uint32_t i : sample) ++counts[i];
  }
  for (const int count : counts) EXPECT_NEAR(count, 3000, 200);  // over four standard deviations
}

TEST(DrawSample, TakesEverythingWhenTheSampleIsTheWhole) {
  Random random(3);
  std::array<uint32_t, 4> sample{};
  DrawSample(random, 4, sample);
  std::sort(sample.begin(), sample.end());
  EXPECT_EQ(sample, (std::array<uint32_t, 4>{0, 1, 2, 3}));
}

std::vector<uint32_t> FromLast(uint32_t size) {
  std::vector<uint32_t> best_first(size);
  for (uint32_t i = 0; i < size; ++i) best_first[i] = size - 1 - i;
  return best_first;
}

TEST(SampleSource, DrawsEveryOtherSampleFromTheBestFirst) {
  constexpr uint32_t kSize = 1000;
  const std::vector<uint32_t> best_first = FromLast(kSize);
  SampleSource samples(1, kSize, best_first);
  std::array<uint32_t, 5> sample{};
  uint32_t worst = kSize;
  std::array<double, 2> sums{};
  for (uint32_t trial = 0; trial < 200; ++trial) {
    samples.Draw(sample);
    EXPECT_EQ(std::set<uint32_t>(sample.begin(), sample.end()).size(), 5U);
    EXPECT_LT(*std::ranges::max_element(sample), kSize);
    for (const uint32_t i : sample) sums[trial % 2] += i / (5.0 * 100.0);
    if (trial % 2 == 1) continue;
    // One more of the best takes part with every sample, so that each is tried.
    worst = std::min(worst, *std::ranges::min_element(sample));
    EXPECT_GE(worst, kSize - 5 - trial / 2) << trial;
  }
  EXPECT_GT(sums[0], 930.0);
  EXPECT_NEAR(sums[1], 499.5, 52.0);  // four standard deviations
}

TEST(SampleSource, ComesToAllDataAtLast) {
  const std::vector<uint32_t> best_first = FromLast(20);
  SampleSource samples(2, 20, best_first);
  std::array<uint32_t, 3> sample{};
  std::array<int, 20> counts{};
  for (int trial = 0; trial < 500000; ++trial) {
    samples.Draw(sample);
    if (trial < 400000) continue;
    for (const uint32_t i : sample) ++counts[i];
  }
  for (const int count : counts) EXPECT_NEAR(count, 15000, 500);
}

TEST(SampleSource, DrawsAllAlikeWhereNoOrderIsKnown) {
  SampleSource samples(3, 50, {});
  Random random(3);
  std::array<uint32_t, 5> sample{};
  std::array<uint32_t, 5> drawn{};
  for (int trial = 0; trial < 100; ++trial) {
    samples.Draw(sample);
    DrawSample(random, 50, drawn);
    EXPECT_EQ(sample, drawn);
  }
}

TEST(SampleSource, TakesEverythingWhenTheSampleIsTheWhole) {
  const std::vector<uint32_t> best_first = FromLast(4);
  SampleSource samples(4, 4, best_first);
  std::array<uint32_t, 4> sample{};
  for (int trial = 0; trial < 10; ++trial) {
    samples.Draw(sample);
    std::ranges::sort(sample);
    EXPECT_EQ(sample, (std::array<uint32_t, 4>{0, 1, 2, 3}));
  }
}

TEST(ShuffledOrder, IsAPermutationThatDependsOnTheSeedAlone) {
  std::vector<uint32_t> order = ShuffledOrder(100, 7);
  EXPECT_EQ(order, ShuffledOrder(100, 7));
  EXPECT_NE(order, ShuffledOrder(100, 8));
  std::sort(order.begin(), order.end());
  for (uint32_t i = 0; i < 100; ++i) EXPECT_EQ(order[i], i);
  EXPECT_TRUE(ShuffledOrder(0, 7).empty());
}

TEST(RequiredTrials, AgreesWithTheTableOfTheField) {
  // 99.9 % at 30, 50, 70 % outliers, five points.
  EXPECT_EQ(RequiredTrials(0.7, 5, 0.999, 1000000), 38);
  EXPECT_EQ(RequiredTrials(0.5, 5, 0.999, 1000000), 218);
  EXPECT_EQ(RequiredTrials(0.3, 5, 0.999, 1000000), 2840);
}

TEST(RequiredTrials, StaysWithinItsBounds) {
  EXPECT_EQ(RequiredTrials(1.0, 5, 0.999, 1000), 1);
  EXPECT_EQ(RequiredTrials(0.0, 5, 0.999, 1000), 1000);
  EXPECT_EQ(RequiredTrials(0.01, 8, 0.999, 1000), 1000);
}

}  // namespace
}  // namespace orbweave
