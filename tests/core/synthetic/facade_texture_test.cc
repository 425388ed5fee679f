// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/facade_texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace orbweave {
namespace {

TexturePoint PointOfWall(double u_m, double v_m, double pixel_m) {
  return {
      .u_m = u_m, .v_m = v_m, .width_m = 9.0, .height_m = 12.0, .du_m = pixel_m, .dv_m = pixel_m};
}

Colour FacadeColour(const TexturePoint& p, uint32_t seed) { return FacadeSurface(p, seed).colour; }

/// Mean of small pixels over the square that one large pixel covers.
Colour MeanOfSmallPixels(double u_m, double v_m, double pixel_m, uint32_t seed) {
  constexpr int kCount = 12;
  Colour sum = Colour::Zero();
  for (int a = 0; a < kCount; ++a) {
    for (int b = 0; b < kCount; ++b) {
      const double du = ((a + 0.5) / kCount - 0.5) * pixel_m;
      const double dv = ((b + 0.5) / kCount - 0.5) * pixel_m;
      sum += FacadeColour(PointOfWall(u_m + du, v_m + dv, pixel_m / kCount), seed);
    }
  }
  return sum / (kCount * kCount);
}

TEST(FacadeTexture, ALargePixelShowsTheMeanOfSmallOnes) {
  Random random(1);
  constexpr double kPixel_m = 0.05;
  double error = 0.0;
  double contrast = 0.0;
  constexpr int kPlaces = 400;
  for (int k = 0; k < kPlaces; ++k) {
    const double u_m = random.Uniform(0.5, 8.5);
    const double v_m = random.Uniform(0.2, 11.8);
    const Colour filtered = FacadeColour(PointOfWall(u_m, v_m, kPixel_m), 77);
    error += (filtered - MeanOfSmallPixels(u_m, v_m, kPixel_m, 77)).norm();
    contrast += (filtered - FacadeColour(PointOfWall(u_m + 0.4, v_m, kPixel_m), 77)).norm();
  }
  EXPECT_LT(error, 0.35 * contrast);
}

/// Mean difference between the wall and itself `shift_m` further along, in the upper storeys.
double DifferenceAlong(double shift_m, uint32_t seed) {
  double sum = 0.0;
  for (double u = 2.0; u < 4.0; u += 0.05) {
    for (double v = 4.0; v < 8.0; v += 0.05) {
      sum += (FacadeColour(PointOfWall(u, v, 0.1), seed) -
              FacadeColour(PointOfWall(u + shift_m, v, 0.1), seed))
                 .norm();
    }
  }
  return sum;
}

TEST(FacadeTexture, WindowsRepeatAndTheWallDoesNot) {
  constexpr uint32_t kSeed = 5;
  double best_m = 0.0;
  for (double shift_m = 1.5; shift_m < 3.6; shift_m += 0.02) {
    if (best_m == 0.0 || DifferenceAlong(shift_m, kSeed) < DifferenceAlong(best_m, kSeed))
      best_m = shift_m;
  }
  EXPECT_LT(DifferenceAlong(best_m, kSeed), 0.7 * DifferenceAlong(0.6 * best_m, kSeed));
  EXPECT_GT(DifferenceAlong(best_m, kSeed), 40.0);  // 3,200 places differ by more than 0.0125
}

TEST(FacadeTexture, DiffersBetweenHouses) {
  EXPECT_NE(FacadeColour(PointOfWall(3.0, 5.0, 0.01), 1),
            FacadeColour(PointOfWall(3.0, 5.0, 0.01), 2));
}

TEST(CoverInterval, IsTheShareOfThePixelInside) {
  EXPECT_DOUBLE_EQ(CoverInterval(0.5, 0.0, 1.0, 0.1), 1.0);
  EXPECT_DOUBLE_EQ(CoverInterval(0.0, 0.0, 1.0, 0.1), 0.5);
  EXPECT_DOUBLE_EQ(CoverInterval(1.2, 0.0, 1.0, 0.1), 0.0);
  EXPECT_DOUBLE_EQ(CoverInterval(0.5, 0.4, 0.6, 1.0), 0.2);
}

}  // namespace
}  // namespace orbweave
