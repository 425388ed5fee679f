// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/drawing/color_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace orbweave {
namespace {

TEST(ColorOnScale, EndsAreThoseOfTheScaleHoweverFarBeyond) {
  EXPECT_EQ(ColorOnScale(-5.0), ColorOnScale(0.0));
  EXPECT_EQ(ColorOnScale(7.0), ColorOnScale(1.0));
  EXPECT_EQ(ColorOnScale(std::numeric_limits<double>::quiet_NaN()), ColorOnScale(0.0));
}

TEST(ColorOnScale, ChangesEverywhereAndWithoutJumps) {
  for (int i = 0; i < 50; ++i) {
    const Rgb low = ColorOnScale(i / 50.0);
    const Rgb high = ColorOnScale((i + 1) / 50.0);
    const int step = std::abs(high.r - low.r) + std::abs(high.g - low.g) + std::abs(high.b - low.b);
    EXPECT_GT(step, 0) << i;
    EXPECT_LT(step, 30) << i;
  }
}

TEST(ColorOfNumber, NeighboursDiffer) {
  for (size_t i = 0; i < 20; ++i) EXPECT_NE(ColorOfNumber(i), ColorOfNumber(i + 1));
}

}  // namespace
}  // namespace orbweave
