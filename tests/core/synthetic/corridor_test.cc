// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/synthetic/corridor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/rotation.h"
#include "core/synthetic/make_corridor.h"

namespace orbweave {
namespace {

double ResidualPx(const Corridor& corridor, uint32_t image, uint32_t feature) {
  const Eigen::Vector3d point = corridor.points_in_world[corridor.point_of_feature[image][feature]];
  return corridor.features[image].camera.PixelsFromAngle(AngleBetween(
      corridor.cams_from_world[image] * point, corridor.features[image].Bearing(feature)));
}

TEST(Corridor, FeaturesShowTruePointsUpToTheNoise) {
  const Corridor corridor = MakeCorridor({.panoramas = 40, .noise_px = 0.5});
  double sum = 0.0;
  size_t n = 0;
  for (uint32_t i = 0; i < corridor.features.size(); ++i) {
    for (uint32_t f = 0; f < corridor.features[i].size(); ++f, ++n)
      sum += std::pow(ResidualPx(corridor, i, f), 2);
  }
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(n)), 0.5 * std::sqrt(2.0), 0.02);
}

TEST(Corridor, HasAboutAsManyFeaturesAsAsked) {
  const Corridor corridor = MakeCorridor({.panoramas = 100, .shape = CorridorShape::kLoop});
  size_t n = 0;
  for (const Features& features : corridor.features) n += features.size();
  EXPECT_NEAR(static_cast<double>(n) / 100.0, 731.0, 110.0);
}

TEST(Corridor, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const Corridor a = MakeCorridor({.panoramas = 20});
  const Corridor b = MakeCorridor({.panoramas = 20});
  const Corridor c = MakeCorridor({.panoramas = 20, .seed = 2});
  ASSERT_EQ(a.features[7].size(), b.features[7].size());
  EXPECT_EQ(a.features[7].keypoints[3].x_px, b.features[7].keypoints[3].x_px);
  EXPECT_NE(a.features[7].keypoints[3].x_px, c.features[7].keypoints[3].x_px);
}

TEST(Corridor, LoopsCloseAndGridsMeet) {
  for (const CorridorShape shape : {CorridorShape::kLoop, CorridorShape::kGrid}) {
    const Corridor corridor =
        MakeCorridor({.panoramas = 300, .shape = shape, .features_per_panorama = 200});
    const bool meets =
        std::any_of(corridor.pairs.begin(), corridor.pairs.end(), [](const PairMatches& pair) {
          return pair.pair.b.value > pair.pair.a.value + 100;
        });
    EXPECT_TRUE(meets);
  }
}

TEST(Corridor, StraightStreetsHaveCollinearCentresAndNoFarPairs) {
  const Corridor corridor = MakeCorridor({.panoramas = 30, .shape = CorridorShape::kStraight});
  for (const Rigid3& cam : corridor.cams_from_world) EXPECT_NEAR(cam.Centre().y(), 0.0, 1e-9);
  for (const PairMatches& pair : corridor.pairs)
    EXPECT_LE(pair.pair.b.value - pair.pair.a.value, 9U);
}

TEST(Corridor, HasTheShareOfWrongMatchesAskedFor) {
  const Corridor corridor = MakeCorridor({.panoramas = 40, .outlier_share = 0.3});
  size_t wrong = 0;
  size_t all = 0;
  for (const PairMatches& pair : corridor.pairs) {
    for (const FeatureMatch& match : pair.matches) {
      wrong += corridor.point_of_feature[pair.pair.a.value][match.a] !=
               corridor.point_of_feature[pair.pair.b.value][match.b];
      ++all;
    }
  }
  EXPECT_NEAR(static_cast<double>(wrong) / static_cast<double>(all), 0.3, 0.01);
}

TEST(Corridor, RandomRotationsChangeBearingsAndNotTheStreet) {
  const Corridor plain = MakeCorridor({.panoramas = 10, .noise_px = 0.0});
  const Corridor turned =
      MakeCorridor({.panoramas = 10, .noise_px = 0.0, .random_rotations = true});
  ASSERT_EQ(plain.points_in_world.size(), turned.points_in_world.size());
  EXPECT_GT(RotationAngle(plain.cams_from_world[3].rotation *
                          turned.cams_from_world[3].rotation.conjugate()),
            0.1);
  EXPECT_LT(ResidualPx(turned, 3, 5), 1e-2);
}

}  // namespace
}  // namespace orbweave
