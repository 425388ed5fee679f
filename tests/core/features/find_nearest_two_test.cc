// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/find_nearest_two.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"
#include "core/features/nearest_two.h"
#include "core/scene/features.h"
#include "tests/core/features/squared_distance.h"

namespace orbweave {
namespace {

std::vector<uint8_t> RandomBytes(size_t count, uint32_t levels, uint64_t seed) {
  Random random(seed);
  std::vector<uint8_t> bytes(count * kDescriptorSize);
  for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.Index(levels));
  return bytes;
}

/// By sorting all distances.
std::vector<NearestTwo> BySorting(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
  std::vector<NearestTwo> all;
  for (size_t i = 0; i < a.size(); i += kDescriptorSize) {
    std::vector<std::pair<int32_t, uint32_t>> distances;
    for (size_t j = 0; j < b.size(); j += kDescriptorSize) {
      distances.emplace_back(testing::SquaredDistance(&a[i], &b[j]),
                             static_cast<uint32_t>(j / kDescriptorSize));
    }
    std::sort(distances.begin(), distances.end());
    NearestTwo nearest;
    if (!distances.empty()) {
      nearest.best = distances[0].first;
      nearest.index = distances[0].second;
    }
    if (distances.size() > 1) nearest.second = distances[1].first;
    all.push_back(nearest);
  }
  return all;
}

class EveryKernel : public ::testing::TestWithParam<DistanceKernel> {};
INSTANTIATE_TEST_SUITE_P(Kernels, EveryKernel, ::testing::ValuesIn(AvailableDistanceKernels()));

TEST_P(EveryKernel, AgreesWithSorting) {
  const std::pair<size_t, size_t> sizes[] = {
      {1, 1}, {1, 2}, {7, 16}, {8, 17}, {9, 15}, {100, 75}, {33, 130}};
  for (const auto& [num_a, num_b] : sizes) {
    const auto a = RandomBytes(num_a, 256, num_a);
    const auto b = RandomBytes(num_b, 256, 1000 + num_b);
    const NearestTwoBothWays nearest = FindNearestTwo(a, b, GetParam());
    EXPECT_EQ(nearest.of_a, BySorting(a, b)) << num_a << " x " << num_b;
    EXPECT_EQ(nearest.of_b, BySorting(b, a)) << num_a << " x " << num_b;
  }
}

TEST_P(EveryKernel, TakesTheFirstOfEquallyNear) {
  std::vector<uint8_t> a = RandomBytes(60, 2, 1);
  std::vector<uint8_t> b = a;
  b.insert(b.end(), a.begin(), a.end());  // everything twice
  const NearestTwoBothWays nearest = FindNearestTwo(a, b, GetParam());
  EXPECT_EQ(nearest.of_a, BySorting(a, b));
  EXPECT_EQ(nearest.of_b, BySorting(b, a));
  EXPECT_EQ(nearest.of_a[5].second, 0);
}

TEST_P(EveryKernel, SurvivesTheLargestDistances) {
  const std::vector<uint8_t> black(20 * kDescriptorSize, 0);
  const std::vector<uint8_t> white(20 * kDescriptorSize, 255);
  const NearestTwoBothWays nearest = FindNearestTwo(black, white, GetParam());
  EXPECT_EQ(nearest.of_a[3].best, 255 * 255 * kDescriptorSize);
  EXPECT_EQ(FindNearestTwo(white, white, GetParam()).of_b[3].best, 0);
}

TEST_P(EveryKernel, AcceptsEmptySets) {
  const auto some = RandomBytes(3, 256, 1);
  EXPECT_TRUE(FindNearestTwo({}, {}, GetParam()).of_a.empty());
  EXPECT_TRUE(FindNearestTwo({}, some, GetParam()).of_a.empty());
  const NearestTwoBothWays nearest = FindNearestTwo(some, {}, GetParam());
  EXPECT_EQ(nearest.of_a, std::vector<NearestTwo>(3));
  EXPECT_TRUE(nearest.of_b.empty());
}

}  // namespace
}  // namespace orbweave
