// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/match_images/match_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/geometry/sphere_cells.h"
#include "proto/codec/features_codec.h"
#include "tests/support/memory_blobs.h"
#include "tests/support/random_features.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

constexpr size_t kFeatures = 1000;

/// Two panoramas all round, whose features show the same points in the same order.
struct TwoPanoramas {
  Rigid3 b_from_a{};
  Features a{.camera = {4096, 2048}};
  Features b{.camera = {4096, 2048}};
  std::vector<uint32_t> lower_half{};
  testing::MemoryBlobs blobs{};
  MatchRecipe recipe{};

  TwoPanoramas() {
    Random random(2);
    b_from_a = {testing::RandomRotation(random), testing::RandomDirection(random)};
    for (size_t i = 0; i < kFeatures; ++i) {
      const Eigen::Vector3d point = testing::RandomPoint(random, 2.0, 10.0);
      const std::vector<uint8_t> descriptor = testing::RandomDescriptor(random);
      testing::AppendFeature(a, point, descriptor);
      testing::AppendFeature(b, b_from_a * point, descriptor);
    }
    for (uint32_t cell = kNumCarrierCells / 2; cell < kNumCarrierCells; ++cell)
      lower_half.push_back(cell);
    recipe.images = {{ImageId(4), blobs.Put(EncodeFeatures(a).value()).value()},
                     {ImageId(7), blobs.Put(EncodeFeatures(b).value()).value()}};
    recipe.pairs = {{.pair = {ImageId(4), ImageId(7)}}};
  }

  std::vector<FeatureMatch> Match() {
    const auto run = MatchRun(recipe, blobs, {}, {}, {});
    EXPECT_TRUE(run.ok()) << run.status();
    EXPECT_EQ(run->verified.size(), 1U);
    EXPECT_EQ(run->matched.size(), 1U);
    if (run->verified.empty()) return {};
    const TwoViewGeometry& geometry = run->verified.front();
    EXPECT_LT(testing::RotationError(geometry.b_from_a.rotation, b_from_a.rotation), 1e-3);
    for (const FeatureMatch& match : geometry.inliers)
      EXPECT_EQ(match.a, match.b) << "by the numbers that the images have for them";
    return geometry.inliers;
  }
};

bool IsLow(const Features& features, FeatureIndex i) { return features.Bearing(i).y() > 0.0; }

TEST(MatchRun, MatchesAllWhereNothingGoesAlong) {
  EXPECT_GE(TwoPanoramas().Match().size(), kFeatures * 9 / 10);
}

TEST(MatchRun, LeavesOutWhatGoesAlong) {
  TwoPanoramas two;
  two.recipe.carriers = {{.images = {ImageId(4), ImageId(7)}, .cells = two.lower_half}};
  const std::vector<FeatureMatch> matches = two.Match();
  EXPECT_GE(matches.size(), kFeatures / 8);
  for (const FeatureMatch& match : matches)
    EXPECT_FALSE(IsLow(two.a, match.a) || IsLow(two.b, match.b));
}

TEST(MatchRun, LeavesTheImagesOfOtherDrivesAlone) {
  TwoPanoramas two;
  two.recipe.carriers = {{.images = {ImageId(7)}, .cells = two.lower_half}};
  const std::vector<FeatureMatch> matches = two.Match();
  const auto is_low_in_a = [&](const FeatureMatch& match) { return IsLow(two.a, match.a); };
  EXPECT_TRUE(std::ranges::any_of(matches, is_low_in_a));
  for (const FeatureMatch& match : matches) EXPECT_FALSE(IsLow(two.b, match.b));
}

}  // namespace
}  // namespace orbweave
