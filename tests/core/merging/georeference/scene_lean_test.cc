// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/scene_lean.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

const Eigen::Vector3d kAxis = Eigen::Vector3d(0.6, 0.8, 0.0);

// Ground 2.5 m below and walls 9 m beside the panoramas, a share of it scattered anywhere.
std::vector<Eigen::Vector3d> Street(double scattered, double lean_rad, uint64_t seed) {
  Random random(seed);
  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(kAxis);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 2000; ++i) {
    const double along = random.Uniform(-5.0, 5.0);
    const double side = random.Uniform() < 0.5 ? -1.0 : 1.0;
    double across = side * random.Uniform(1.5, 8.0);
    double up = -2.5;
    if (random.Uniform() < scattered) {
      across = random.Uniform(-12.0, 12.0);
      up = random.Uniform(-2.5, 12.0);
    } else if (random.Uniform() < 0.5) {
      across = side * 9.0;
      up = random.Uniform(-2.5, 10.0);
    }
    const Eigen::Vector3d noise(random.Normal(), random.Normal(), random.Normal());
    points.push_back(
        RotationFromVector(lean_rad * kAxis) *
        (along * kAxis + across * left + up * Eigen::Vector3d::UnitZ() + 0.05 * noise));
  }
  return points;
}

TEST(MeasureSceneLean, FindsHowFarAStreetLeans) {
  for (const double lean_deg : {-15.0, -4.0, 0.0, 7.0, 12.0}) {
    for (const double scattered : {0.0, 0.5, 0.85}) {
      const double lean_rad = lean_deg * EIGEN_PI / 180.0;
      const auto lean = MeasureSceneLean(Street(scattered, lean_rad, 1), kAxis);
      ASSERT_TRUE(lean.has_value()) << lean_deg << " " << scattered;
      EXPECT_NEAR(lean->lean_rad, lean_rad, 0.02);
      if (std::abs(lean_deg) > 3.0) {
        EXPECT_GT(lean->sharpness, 2.0);
      }
    }
  }
}

TEST(MeasureSceneLean, IsSilentWhereNothingStandsOut) {
  for (const uint64_t seed : {1U, 2U, 3U})
    EXPECT_FALSE(MeasureSceneLean(Street(1.0, 0.2, seed), kAxis).has_value()) << seed;
  EXPECT_FALSE(MeasureSceneLean({}, kAxis).has_value());
}

}  // namespace
}  // namespace orbweave
