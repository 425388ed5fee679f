// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/select_spread.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.h"

namespace orbweave {
namespace {

constexpr EquirectangularCamera kCamera{.width_px = 1000, .height_px = 500};

std::vector<SiftCandidate> RandomCandidates(int count, uint64_t seed) {
  Random random(seed);
  std::vector<SiftCandidate> candidates(static_cast<size_t>(count));
  for (SiftCandidate& c : candidates) {
    c.keypoint.x_px = static_cast<float>(random.Uniform(0.0, 1000.0));
    c.keypoint.y_px = static_cast<float>(random.Uniform(0.0, 500.0));
    c.response = static_cast<float>(random.Uniform());
  }
  return candidates;
}

TEST(SelectSpread, KeepsAllWhenThereAreFew) {
  EXPECT_EQ(SelectSpread(kCamera, RandomCandidates(50, 1), 100).size(), 50U);
  EXPECT_TRUE(SelectSpread(kCamera, {}, 100).empty());
}

TEST(SelectSpread, SparesAWeakRegionFromAStrongOne) {
  std::vector<SiftCandidate> candidates = RandomCandidates(4000, 2);
  for (SiftCandidate& c : candidates) c.response += c.keypoint.x_px < 500.0F ? 10.0F : 0.0F;
  size_t weak = 0;
  for (const SiftCandidate& c : SelectSpread(kCamera, candidates, 1000))
    weak += c.response < 10.0F ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(weak), 500.0, 100.0);
}

TEST(SelectSpread, TakesTheStrongestOfEveryPlace) {
  std::vector<SiftCandidate> candidates;
  for (int i = 0; i < 10; ++i) {
    candidates.push_back(
        {.keypoint = {.x_px = 500.0F, .y_px = 251.0F}, .response = static_cast<float>(i)});
  }
  const auto selected = SelectSpread(kCamera, candidates, 3);
  ASSERT_EQ(selected.size(), 3U);
  for (const SiftCandidate& c : selected) EXPECT_GE(c.response, 7.0F);
}

TEST(SelectSpread, DoesNotDependOnTheOrderOfCandidates) {
  std::vector<SiftCandidate> candidates = RandomCandidates(2000, 3);
  for (SiftCandidate& c : candidates) c.response = std::round(4.0F * c.response);  // many equals
  const auto forwards = SelectSpread(kCamera, candidates, 500);
  std::reverse(candidates.begin(), candidates.end());
  const auto backwards = SelectSpread(kCamera, candidates, 500);
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
