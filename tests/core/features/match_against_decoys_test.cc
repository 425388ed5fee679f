// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/match_against_decoys.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/features/find_nearest_two.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr EquirectangularCamera kCamera{.width_px = 2048, .height_px = 1024};
const double kMaxErrorRad = kCamera.AngleFromPixels(4.0);

std::vector<uint8_t> RandomDescriptor(Random& random) {
  std::vector<double> values(kDescriptorSize);
  double squares = 0.0;
  for (double& value : values) {
    value = std::pow(random.Uniform(), 3.0);
    squares += value * value;
  }
  std::vector<uint8_t> descriptor;
  for (const double value : values)
    descriptor.push_back(static_cast<uint8_t>(std::lround(value * 512.0 / std::sqrt(squares))));
  return descriptor;
}

/// The descriptor as another day shows it.
std::vector<uint8_t> Changed(Random& random, std::vector<uint8_t> descriptor, double noise) {
  for (uint8_t& value : descriptor) {
    const double changed = value + noise * random.Normal();
    value = static_cast<uint8_t>(std::clamp(changed, 0.0, 255.0));
  }
  return descriptor;
}

void Append(Features& features, const Vector3d& ray, const std::vector<uint8_t>& descriptor) {
  const Eigen::Vector2d pixel = features.camera.PixelFromBearing(ray);
  features.keypoints.push_back(
      {.x_px = static_cast<float>(pixel.x()), .y_px = static_cast<float>(pixel.y())});
  features.descriptors.insert(features.descriptors.end(), descriptor.begin(), descriptor.end());
}

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
    const std::vector<uint8_t> descriptor = RandomDescriptor(random);
    Append(scene.a, point, descriptor);
    Append(scene.b, scene.b_from_a * point, Changed(random, descriptor, 8.0));
  }
  for (int i = 0; i < num_others; ++i) {
    Append(scene.a, direction(), RandomDescriptor(random));
    Append(scene.b, direction(), RandomDescriptor(random));
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
