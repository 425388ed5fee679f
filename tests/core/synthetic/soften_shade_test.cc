// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/soften_shade.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace orbweave {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 32;

RenderedPanorama Even(uint8_t level) {
  RenderedPanorama image{.camera = {kWidth, kHeight}};
  image.pixels.assign(kWidth * kHeight, {level, level, level});
  return image;
}

TEST(SoftenShade, SpreadsADotWhereItIsDarkOnly) {
  for (const uint8_t level : {uint8_t{20}, uint8_t{200}}) {
    RenderedPanorama image = Even(level);
    Rgb& dot = image.pixels[10 * kWidth + 20];
    dot.r = static_cast<uint8_t>(level + 40);
    SoftenShade(image, 1.5);
    const int left = image.pixels[10 * kWidth + 20].r - level;
    if (level == 20) {
      EXPECT_LT(left, 6);
      EXPECT_GT(image.pixels[10 * kWidth + 21].r, level);
    } else {
      EXPECT_EQ(left, 40);
    }
  }
}

TEST(SoftenShade, TheSeamIsNowhereSpecial) {
  RenderedPanorama at_seam = Even(20);
  RenderedPanorama inside = Even(20);
  at_seam.pixels[10 * kWidth] = {90, 90, 90};
  inside.pixels[10 * kWidth + 30] = {90, 90, 90};
  SoftenShade(at_seam, 2.0);
  SoftenShade(inside, 2.0);
  for (int i = 0; i < kWidth; ++i) {
    EXPECT_EQ(at_seam.pixels[static_cast<size_t>(10 * kWidth + i)].r,
              inside.pixels[static_cast<size_t>(10 * kWidth + (i + 30) % kWidth)].r)
        << i;
  }
}

}  // namespace
}  // namespace orbweave
