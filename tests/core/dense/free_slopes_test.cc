// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/free_slopes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "core/dense/match_kernel.h"

namespace orbweave {
namespace {

constexpr int kSize = 64;
constexpr int kMiddle = 16;
constexpr float kVariance_px2 = 0.01F;
constexpr ParallaxDirections kAlongColumns{1.0F, 0.0F, 0.0F};
constexpr ParallaxDirections kAlongRows{0.0F, 0.0F, 1.0F};

/// Moments of a picture about its pixel (kMiddle, kMiddle), the first lane.
TextureMoments MomentsOf(const std::function<int(int row, int column)>& level,
                         const ParallaxDirections& directions) {
  std::vector<uint8_t> picture;
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column)
      picture.push_back(static_cast<uint8_t>(level(row - kMiddle, column - kMiddle)));
  }
  const uint8_t* const middle = &picture[kMiddle * kSize + kMiddle];
  ReferencePatches patches;
  PreparePatches(middle, kSize, patches);
  return MomentsOfTexture(middle, kSize, patches, directions, 0.5F);
}

float VarianceOf(const std::function<int(int row, int column)>& level,
                 const ParallaxDirections& directions,
                 float slope) {
  return FreeSlopeVariance(MomentsOf(level, directions), 0, kVariance_px2, slope);
}

int EdgeAt(int from, int place) { return place < from ? 80 : 120; }

TEST(FreeSlopes, TextureAllAroundKnowsTheRangeOfItsMiddle) {
  const auto waves = [](int row, int column) { return ((row + column) & 2) != 0 ? 80 : 120; };
  EXPECT_LT(VarianceOf(waves, kAlongColumns, 1.0F), 1.1F * kVariance_px2);
}

TEST(FreeSlopes, AnEdgeBesideTheMiddleKnowsItsRangeAsTheSlopeAllows) {
  const auto edge = [](int /*row*/, int column) { return EdgeAt(4, column); };
  const TextureMoments moments = MomentsOf(edge, kAlongColumns);
  EXPECT_NEAR(moments.column[0], 3.5F, 0.6F);
  EXPECT_NEAR(moments.row[0], 0.0F, 1e-4F);
  const float away = moments.column[0];
  for (const float slope : {0.1F, 1.0F}) {
    EXPECT_NEAR(VarianceOf(edge, kAlongColumns, slope),
                kVariance_px2 + slope * slope * away * away,
                1e-3F * away * away);
  }
}

TEST(FreeSlopes, AnEdgeThroughTheMiddleKnowsItsRange) {
  const auto edge = [](int /*row*/, int column) { return EdgeAt(0, column); };
  EXPECT_LT(VarianceOf(edge, kAlongColumns, 0.1F), 2.5F * kVariance_px2);
}

TEST(FreeSlopes, EdgesOnBothSidesKnowTheSlope) {
  const auto edges = [](int /*row*/, int column) { return column < -3 || column > 4 ? 80 : 120; };
  EXPECT_LT(VarianceOf(edges, kAlongColumns, 1.0F), 1.5F * kVariance_px2);
}

TEST(FreeSlopes, WhatLiesAlongTheParallaxTellsNothing) {
  const auto edge = [](int row, int /*column*/) { return EdgeAt(4, row); };
  EXPECT_EQ(MomentsOf(edge, kAlongColumns).texture[0], 0.0F);
  EXPECT_GT(MomentsOf(edge, kAlongRows).texture[0], 0.0F);
}

}  // namespace
}  // namespace orbweave
