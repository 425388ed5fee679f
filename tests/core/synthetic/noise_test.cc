// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orbweave {
namespace {

TEST(Noise, IsSmoothAcrossLatticeLines) {
  for (const double u : {-3.0, 0.0, 5.0}) {
    EXPECT_NEAR(ValueNoise(u - 1e-6, 0.3, 1), ValueNoise(u + 1e-6, 0.3, 1), 1e-5);
    const double slope_before = ValueNoise(u - 1e-4, 0.3, 1) - ValueNoise(u - 2e-4, 0.3, 1);
    const double slope_after = ValueNoise(u + 2e-4, 0.3, 1) - ValueNoise(u + 1e-4, 0.3, 1);
    EXPECT_NEAR(slope_before, slope_after, 1e-6);
  }
}

TEST(Noise, DiffersBetweenSeedsAndPlaces) {
  EXPECT_NE(ValueNoise(0.4, 0.7, 1), ValueNoise(0.4, 0.7, 2));
  EXPECT_NE(ValueNoise(0.4, 0.7, 1), ValueNoise(16.4, 0.7, 1));
}

/// Root mean square of the change over `step_m`.
double Roughness(double step_m, double footprint_m) {
  double sum = 0.0;
  constexpr int kSamples = 2000;
  for (int i = 0; i < kSamples; ++i) {
    const double u = 0.37 * i;
    const NoiseBand band{1.0, 0.02};
    sum += std::pow(FractalNoise(u + step_m, 0.1 * i, band, footprint_m, 9) -
                        FractalNoise(u, 0.1 * i, band, footprint_m, 9),
                    2);
  }
  return std::sqrt(sum / kSamples);
}

TEST(Noise, LeavesOutWhatAPixelCannotShow) {
  EXPECT_GT(Roughness(0.02, 0.005), 0.1);
  EXPECT_LT(Roughness(0.02, 0.2), 0.05);
  EXPECT_EQ(FractalNoise(1.2, 3.4, {1.0, 0.02}, 10.0, 9), 0.0);
}

}  // namespace
}  // namespace orbweave
