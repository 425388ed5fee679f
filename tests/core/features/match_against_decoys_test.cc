// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/match_against_decoys.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/features/find_nearest_two.h"
#include "tests/support/random_features.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr EquirectangularCamera kCamera{.width_px = 2048, .height_px = 1024};
const double kMaxErrorRad = kCamera.AngleFromPixels(4.0);

struct Scene {
  Features a{.camera = kCamera};
  Features b{.camera = kCamera};
  Rigid3 b_from_a{Eigen::Quaterniond(0.9, 0.1, 0.3, -0.2).normalized(), Vector3d(0.6, 0.0, 0.8)};
};

/// `num_common` points that both see, as features 0 ... of each, and others that only one sees.
Scene MakeScene(uint64_t seed, int num_common, int num_others) {
  Random random(seed);
  const auto direction = [&] {
    return Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized();
  };
  Scene scene;
  for (int i = 0; i < num_common; ++i) {
    const Vector3d point = random.Uniform(2.0, 20.0) * direction();
    const std::vector<uint8_t> descriptor = testing::RandomDescriptor(random);
    testing::AppendFeature(scene.a, point, descriptor);
    testing::AppendFeature(
        scene.b, scene.b_from_a * point, testing::ChangedDescriptor(random, descriptor, 8.0));
  }
  for (int i = 0; i < num_others; ++i) {
    testing::AppendFeature(scene.a, direction(), testing::RandomDescriptor(random));
    testing::AppendFeature(scene.b, direction(), testing::RandomDescriptor(random));
  }
  return scene;
}

enum class Yardstick { kWholeImages, kPlanesThatCompete };

PredictedMatches Match(const Scene& scene,
                       const std::vector<FeatureMatch>& known = {},
                       Yardstick yardstick = Yardstick::kWholeImages) {
  const NearestTwoBothWays nearest = FindNearestTwo(scene.a.descriptors, scene.b.descriptors);
  return MatchAgainstDecoys(PairSide(scene.a),
                            PairSide(scene.b),
                            scene.b_from_a,
                            kMaxErrorRad,
                            yardstick == Yardstick::kWholeImages ? &nearest : nullptr,
                            known,
                            {});
}

TEST(MatchAgainstDecoys, FindsWhatBothSee) {
  const Scene scene = MakeScene(1, 150, 300);
  const PredictedMatches predicted = Match(scene);
  size_t right = 0;
  for (const FeatureMatch& match : predicted.matches) right += match.a == match.b && match.a < 150;
  EXPECT_GE(right, 140U);
  EXPECT_LE(predicted.matches.size() - right, predicted.matches.size() / 5);
  EXPECT_LT(predicted.log10_chance, -20.0);
}

TEST(MatchAgainstDecoys, FindsNothingWhereNothingIsCommon) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const PredictedMatches predicted = Match(MakeScene(seed, 0, 2000));
    EXPECT_LT(predicted.matches.size(), 10U) << seed;
    EXPECT_GT(predicted.log10_chance, -4.0) << seed;
  }
}

TEST(MatchAgainstDecoys, TakesNoEvidenceFromWhatIsKnown) {
  const Scene scene = MakeScene(3, 60, 600);
  std::vector<FeatureMatch> known;
  for (uint32_t i = 0; i < 60; ++i) known.push_back({i, i});
  const PredictedMatches predicted = Match(scene, known);
  EXPECT_GT(predicted.log10_chance, -3.0);
  EXPECT_GE(predicted.matches.size(), 50U);
}

TEST(MatchAgainstDecoys, PlanesThatCompeteFindWhatWholeImagesDo) {
  const Scene scene = MakeScene(4, 400, 1500);
  const PredictedMatches whole = Match(scene);
  const PredictedMatches competing = Match(scene, {}, Yardstick::kPlanesThatCompete);
  size_t right = 0;
  for (const FeatureMatch& match : competing.matches) right += match.a == match.b && match.a < 400;
  EXPECT_GE(right, 0.95 * static_cast<double>(whole.matches.size()));
  EXPECT_LE(competing.matches.size() - right, competing.matches.size() / 5);
}

TEST(MatchAgainstDecoys, PlanesThatCompeteFindNothingWhereNothingIsCommon) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const PredictedMatches predicted =
        Match(MakeScene(seed, 0, 2000), {}, Yardstick::kPlanesThatCompete);
    EXPECT_LT(predicted.matches.size(), 10U) << seed;
    EXPECT_GT(predicted.log10_chance, -4.0) << seed;
  }
}

}  // namespace
}  // namespace orbweave
