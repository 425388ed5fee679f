// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/sky_texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace orbweave {
namespace {

Eigen::Vector3d Direction(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad),
          std::sin(elevation_rad)};
}

TEST(SkyTexture, HasNoSeamAndNoPole) {
  constexpr double kPixel_rad = 0.003;
  for (const double elevation : {0.02, 0.4, 1.2}) {
    const Colour before = SkyColour(Direction(std::numbers::pi - 1e-7, elevation), kPixel_rad, 1);
    const Colour after = SkyColour(Direction(-std::numbers::pi + 1e-7, elevation), kPixel_rad, 1);
    EXPECT_LT((before - after).norm(), 1e-3);
  }
  const double zenith = std::numbers::pi / 2.0 - 1e-7;
  EXPECT_LT((SkyColour(Direction(0.0, zenith), kPixel_rad, 1) -
             SkyColour(Direction(2.0, zenith), kPixel_rad, 1))
                .norm(),
            1e-3);
}

TEST(SkyTexture, HillsAreDarkerThanTheSkyAbove) {
  double hills = 0.0;
  double sky = 0.0;
  for (double azimuth = 0.0; azimuth < 6.28; azimuth += 0.01) {
    hills += SkyColour(Direction(azimuth, -0.1), 0.003, 1).mean();
    sky += SkyColour(Direction(azimuth, 0.25), 0.003, 1).mean();
  }
  EXPECT_LT(hills, 0.8 * sky);
}

}  // namespace
}  // namespace orbweave
