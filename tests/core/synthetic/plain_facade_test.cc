// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/plain_facade.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/synthetic/facade_texture.h"

namespace orbweave {
namespace {

constexpr FacadeLook kPlain{.plain = true};

TexturePoint PointOfWall(double u_m, double v_m, double pixel_m) {
  return {
      .u_m = u_m, .v_m = v_m, .width_m = 9.0, .height_m = 12.0, .du_m = pixel_m, .dv_m = pixel_m};
}

TEST(PlainFacade, ALargePixelShowsTheMeanOfSmallOnes) {
  Random random(1);
  constexpr double kPixel_m = 0.05;
  constexpr int kCount = 12;
  double error = 0.0;
  double contrast = 0.0;
  for (int k = 0; k < 400; ++k) {
    const double u_m = random.Uniform(0.5, 8.5);
    const double v_m = random.Uniform(0.2, 11.8);
    const Colour filtered = PlainFacade(PointOfWall(u_m, v_m, kPixel_m), 77, kPlain).colour;
    Colour mean = Colour::Zero();
    for (int a = 0; a < kCount * kCount; ++a) {
      const double du = ((a % kCount + 0.5) / kCount - 0.5) * kPixel_m;
      const double dv = ((a / kCount + 0.5) / kCount - 0.5) * kPixel_m;
      const TexturePoint small = PointOfWall(u_m + du, v_m + dv, kPixel_m / kCount);
      mean += PlainFacade(small, 77, kPlain).colour / (kCount * kCount);
    }
    error += (filtered - mean).norm();
    contrast +=
        (filtered - PlainFacade(PointOfWall(u_m + 0.4, v_m, kPixel_m), 77, kPlain).colour).norm();
  }
  EXPECT_LT(error, 0.35 * contrast);
}

/// Median relative difference of brightness between places 10 cm apart: that of the bare wall.
double MedianContrast(const FacadeLook& look) {
  std::vector<double> differences;
  Random random(2);
  for (uint32_t seed = 1; seed < 40; ++seed) {
    for (int k = 0; k < 100; ++k) {
      const double u_m = random.Uniform(0.5, 8.4);
      const double v_m = random.Uniform(4.5, 10.0);
      const double here = FacadeSurface(PointOfWall(u_m, v_m, 0.03), seed, look).colour.mean();
      const double there =
          FacadeSurface(PointOfWall(u_m + 0.1, v_m, 0.03), seed, look).colour.mean();
      differences.push_back(std::abs(here - there) / here);
    }
  }
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return *middle;
}

TEST(PlainFacade, HasAFifthOfTheTextureOfOthers) {
  EXPECT_LT(MedianContrast(kPlain), 0.2 * MedianContrast({}));
}

TEST(PlainFacade, OtherWaresChangeShopsAlone) {
  double street_level = 0.0;
  for (uint32_t seed = 1; seed < 20; ++seed) {
    for (double u_m = 0.5; u_m < 8.5; u_m += 0.13) {
      for (double v_m = 0.1; v_m < 11.0; v_m += 0.17) {
        const TexturePoint p = PointOfWall(u_m, v_m, 0.02);
        const double change = (PlainFacade(p, seed, {.plain = true, .wares = 5}).colour -
                               PlainFacade(p, seed, kPlain).colour)
                                  .norm();
        if (v_m < 3.45) {
          street_level += change;
        } else {
          ASSERT_EQ(change, 0.0) << u_m << " " << v_m;
        }
      }
    }
  }
  EXPECT_GT(street_level, 10.0);
}

TEST(PlainFacade, EqualWindowsAreEqual) {
  constexpr FacadeLook kEqual{.plain = true, .equal_windows = true};
  for (uint32_t seed = 1; seed < 6; ++seed) {
    // The bay's width is not known here: the shift that repeats best repeats well.
    double best = 1e9;
    for (double shift_m = 2.0; shift_m < 3.4; shift_m += 0.005) {
      double sum = 0.0;
      for (double u_m = 3.0; u_m < 4.5; u_m += 0.05) {
        const Colour here = FacadeSurface(PointOfWall(u_m, 5.6, 0.05), seed, kEqual).colour;
        sum += (here - FacadeSurface(PointOfWall(u_m + shift_m, 5.6, 0.05), seed, kEqual).colour)
                   .norm();
      }
      best = std::min(best, sum / 30.0);
    }
    EXPECT_LT(best, 0.035) << seed;
  }
}

}  // namespace
}  // namespace orbweave
