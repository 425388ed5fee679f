// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/residual_pattern.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/synthetic/make_corridor.h"
#include "tests/core/merging/adjust_globally.h"
#include "tests/core/merging/corridor_model.h"

namespace orbweave {
namespace {

constexpr double kPxPerRad = 860.0;

/// Rays all round with a pixel of noise, and `shift_px(azimuth)` sideways.
template <typename Shift>
ResidualPattern PatternOf(const Shift& shift_px) {
  Random random(1);
  ResidualPattern pattern;
  for (int i = 0; i < 50000; ++i) {
    const Eigen::Vector3d ray = testing::RandomDirection(random);
    const double azimuth = std::atan2(ray.x(), ray.z());
    const Eigen::Vector3d sideways(std::cos(azimuth), 0.0, -std::sin(azimuth));
    const Eigen::Vector3d noise(random.Normal(), random.Normal(), random.Normal());
    const Eigen::Vector3d error = noise + shift_px(azimuth) * sideways;
    pattern.Add((ray + error / kPxPerRad).normalized(), ray, kPxPerRad);
  }
  return pattern;
}

TEST(ResidualPattern, FindsNothingInNoise) {
  EXPECT_EQ(PatternOf([](double) { return 0.0; }).LargestPx(1.4), 0.0);
}

TEST(ResidualPattern, FindsWhatRepeatsInEveryPanorama) {
  // Six lenses: rays lean away from the middle of each.
  const auto lenses = [](double azimuth) { return std::sin(6.0 * azimuth); };
  EXPECT_NEAR(PatternOf(lenses).LargestPx(1.4), 0.95, 0.15);
}

TEST(ResidualPattern, TheSeamIsNowhereSpecial) {
  const auto near_seam = [](double azimuth) { return std::cos(azimuth) < -0.95 ? 1.0 : 0.0; };
  EXPECT_NEAR(PatternOf(near_seam).LargestPx(1.4), 1.0, 0.2);
}

TEST(ResidualPattern, FindsWhatRepeatsOverLatitude) {
  Random random(2);
  ResidualPattern pattern;
  for (int i = 0; i < 50000; ++i) {
    const Eigen::Vector3d ray = testing::RandomDirection(random);
    const double latitude = std::asin(-ray.y());
    const Eigen::Vector3d up = -Eigen::Vector3d::UnitY() - std::sin(latitude) * ray;
    const Eigen::Vector3d noise(random.Normal(), random.Normal(), random.Normal());
    const Eigen::Vector3d error = noise + std::sin(2.0 * latitude) * up.normalized();
    pattern.Add((ray + error / kPxPerRad).normalized(), ray, kPxPerRad);
  }
  EXPECT_EQ(pattern.LargestOverAzimuthPx(1.4), 0.0);
  EXPECT_NEAR(pattern.LargestOverLatitudePx(1.4), 1.0, 0.15);
  const CrossCheck check = CheckResidualPattern(pattern, 1.4);
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_NE(check.sentence.find("latitude"), std::string::npos);
}

TEST(ResidualPattern, APanoramaThatIsTooTallShowsInAnAdjustedModel) {
  const Corridor corridor =
      MakeCorridor({.panoramas = 40, .features_per_panorama = 400, .gnss_sigma_m = 0.0});
  const auto check_of = [&](double stretch) {
    Reconstruction model = testing::TrueModel(corridor);
    for (Track& track : model.tracks) {
      for (Observation& seen : track.observations) {
        const double latitude = stretch * std::asin(-seen.bearing.y());
        const double azimuth = std::atan2(seen.bearing.x(), seen.bearing.z());
        seen.bearing = {std::cos(latitude) * std::sin(azimuth),
                        -std::sin(latitude),
                        std::cos(latitude) * std::cos(azimuth)};
      }
    }
    const auto adjusted = testing::AdjustGlobally(model, corridor.manifest, {}, {}, {}).value();
    const auto found =
        std::ranges::find(adjusted.report.checks, "residual_pattern", &CrossCheck::name);
    EXPECT_NE(found, adjusted.report.checks.end());
    return *found;
  };
  EXPECT_EQ(check_of(1.0).level, CheckLevel::kGood);
  const CrossCheck tall = check_of(1.0 / 1.03);
  EXPECT_EQ(tall.level, CheckLevel::kDoubtful) << tall.value;
  EXPECT_NE(tall.sentence.find("latitude"), std::string::npos);
}

TEST(ResidualPattern, SumsOfPartsAreThatOfTheWhole) {
  const ResidualPattern half = PatternOf([](double) { return 0.5; });
  ResidualPattern whole = half;
  whole.Add(half);
  EXPECT_EQ(whole.count[7], 2 * half.count[7]);
  EXPECT_NEAR(whole.LargestPx(1.4), half.LargestPx(1.4), 1e-9);
}

}  // namespace
}  // namespace orbweave
