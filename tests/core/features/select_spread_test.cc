// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/select_spread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/base/random.h"

namespace orbweave {
namespace {

constexpr EquirectangularCamera kCamera{.width_px = 1000, .height_px = 500};

std::vector<ScoredKeypoint> RandomCandidates(int count, uint64_t seed) {
  Random random(seed);
  std::vector<ScoredKeypoint> candidates(static_cast<size_t>(count));
  for (ScoredKeypoint& c : candidates) {
    c.keypoint.x_px = static_cast<float>(random.Uniform(0.0, 1000.0));
    c.keypoint.y_px = static_cast<float>(random.Uniform(0.0, 500.0));
    c.response = static_cast<float>(random.Uniform());
  }
  return candidates;
}

/// The selected candidates themselves.
std::vector<ScoredKeypoint> Select(const std::vector<ScoredKeypoint>& candidates,
                                   size_t max_features) {
  std::vector<ScoredKeypoint> selected;
  for (const uint32_t i : SelectSpread(kCamera, candidates, max_features))
    selected.push_back(candidates[i]);
  return selected;
}

TEST(SelectSpread, KeepsAllWhenThereAreFew) {
  EXPECT_EQ(Select(RandomCandidates(50, 1), 100).size(), 50U);
  EXPECT_TRUE(Select({}, 100).empty());
}

TEST(SelectSpread, GivesAWeakRegionMoreThanItsStrengthAlone) {
  std::vector<ScoredKeypoint> candidates = RandomCandidates(8000, 2);
  for (ScoredKeypoint& c : candidates) c.response *= c.keypoint.x_px < 500.0F ? 2.0F : 1.0F;
  std::vector<float> responses;
  for (const ScoredKeypoint& c : candidates) responses.push_back(c.response);
  std::nth_element(responses.begin(), responses.begin() + 1000, responses.end(), std::greater<>());
  const float strongest_thousand = responses[1000];
  size_t weak = 0;
  size_t weak_by_strength = 0;
  for (const ScoredKeypoint& c : Select(candidates, 1000))
    weak += c.keypoint.x_px >= 500.0F ? 1 : 0;
  for (const ScoredKeypoint& c : candidates) {
    weak_by_strength += c.response > strongest_thousand && c.keypoint.x_px >= 500.0F ? 1 : 0;
  }
  EXPECT_EQ(weak_by_strength, 0U);
  EXPECT_GT(weak, 50U);
  EXPECT_LT(weak, 500U);
}

TEST(SelectSpread, PrefersCoarseScalesOfEqualContrast) {
  std::vector<ScoredKeypoint> candidates = RandomCandidates(1000, 4);
  for (size_t i = 0; i < candidates.size(); ++i) {
    candidates[i].response = 1.0F;
    candidates[i].keypoint.scale_px = i % 2 == 0 ? 1.0F : 4.0F;
  }
  for (const ScoredKeypoint& c : Select(candidates, 300)) EXPECT_EQ(c.keypoint.scale_px, 4.0F);
}

TEST(SelectSpread, TakesTheStrongestOfEveryPlace) {
  std::vector<ScoredKeypoint> candidates;
  for (int i = 0; i < 10; ++i) {
    candidates.push_back(
        {.keypoint = {.x_px = 500.0F, .y_px = 251.0F}, .response = static_cast<float>(i)});
  }
  const auto selected = Select(candidates, 3);
  ASSERT_EQ(selected.size(), 3U);
  for (const ScoredKeypoint& c : selected) EXPECT_GE(c.response, 7.0F);
}

TEST(SelectSpread, DoesNotDependOnTheOrderOfCandidates) {
  std::vector<ScoredKeypoint> candidates = RandomCandidates(2000, 3);
  for (ScoredKeypoint& c : candidates) c.response = std::round(4.0F * c.response);  // many equals
  const auto forwards = Select(candidates, 500);
  std::reverse(candidates.begin(), candidates.end());
  const auto backwards = Select(candidates, 500);
  ASSERT_EQ(forwards.size(), backwards.size());
  for (size_t i = 0; i < forwards.size(); ++i) {
    EXPECT_EQ(forwards[i].keypoint.x_px, backwards[i].keypoint.x_px);
    EXPECT_EQ(forwards[i].keypoint.y_px, backwards[i].keypoint.y_px);
    if (i > 0) {
      EXPECT_LE(forwards[i - 1].keypoint.y_px, forwards[i].keypoint.y_px);
    }
  }
}

}  // namespace
}  // namespace orbweave
