// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/noise_by_level.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace orbweave {
namespace {

/// A ramp from dark to bright, with noise of `dark` levels in its darker half and `bright` in the
/// other.
GreyPanorama NoisyRamp(double dark, double bright) {
  constexpr int kWidth_px = 512;
  Random random(1);
  std::vector<uint8_t> levels;
  for (int row = 0; row < kWidth_px / 2; ++row) {
    for (int column = 0; column < kWidth_px; ++column) {
      const double level = 20.0 + 200.0 * column / kWidth_px;
      const double noise = (level < 128.0 ? dark : bright) * random.Normal();
      levels.push_back(static_cast<uint8_t>(std::clamp(std::lround(level + noise), 1L, 254L)));
    }
  }
  return MakeGreyPanorama({kWidth_px, kWidth_px / 2, 1, levels, {}});
}

TEST(EstimateNoise, TellsTheNoiseOfDarkFromThatOfBrightParts) {
  const NoiseByLevel noise = EstimateNoise(NoisyRamp(4.0, 1.5), 0.1F, 100.0F);
  EXPECT_NEAR(std::sqrt(noise.At(60.0F)), 4.0F, 0.6F);
  EXPECT_NEAR(std::sqrt(noise.At(190.0F)), 1.5F, 0.3F);
}

TEST(EstimateNoise, StaysWithinItsBounds) {
  const NoiseByLevel noise = EstimateNoise(NoisyRamp(8.0, 0.0), 0.5F, 9.0F);
  EXPECT_EQ(noise.At(60.0F), 9.0F);
  EXPECT_EQ(noise.At(190.0F), 0.5F);
  EXPECT_EQ(noise.At(255.0F), 0.5F);  // a level that the image does not have
}

}  // namespace
}  // namespace orbweave
