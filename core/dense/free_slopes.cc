// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/free_slopes.h"

#include <algorithm>
#include <cmath>

namespace orbweave {
namespace {

constexpr float kBlur_px2 = 1.0F;  // second moment of an edge, which tells nothing of slopes

/// Difference of the levels of each lane at two places.
LaneFloats Difference(const uint8_t* to, const uint8_t* from) {
  std::array<int16_t, kMatchLanes> levels;
  for (size_t k = 0; k < kMatchLanes; ++k)
    levels[k] = static_cast<int16_t>(to[2 * k] - from[2 * k]);
  LaneFloats difference;
  for (size_t k = 0; k < kMatchLanes; ++k) difference[k] = static_cast<float>(levels[k]);
  return difference;
}

/// Adds one tap of each lane, `at` being that of the first.
void AddTap(const uint8_t* at,
            int stride,
            int row,
            int column,
            const LaneFloats& weights,
            const ParallaxDirections& directions,
            float noise,
            TextureMoments& sums) {
  const auto r = static_cast<float>(row);
  const auto c = static_cast<float>(column);
  const LaneFloats across = Difference(at + 1, at - 1);
  const LaneFloats down = Difference(at + stride, at - stride);
  for (size_t k = 0; k < kMatchLanes; ++k) {
    const float square =
        across[k] * (across[k] * directions.columns + 2.0F * down[k] * directions.both) +
        down[k] * down[k] * directions.rows;
    const float over = square - noise;
    const float q = over > 0.0F ? weights[k] * over : 0.0F;
    sums.texture[k] += q;
    sums.column[k] += q * c;
    sums.row[k] += q * r;
    sums.column_column[k] += q * (c * c);
    sums.column_row[k] += q * (c * r);
    sums.row_row[k] += q * (r * r);
  }
}

void DivideByTexture(TextureMoments& sums) {
  for (size_t k = 0; k < kMatchLanes; ++k) {
    const float factor = sums.texture[k] > 0.0F ? 1.0F / sums.texture[k] : 0.0F;
    for (LaneFloats* const sum :
         {&sums.column, &sums.row, &sums.column_column, &sums.column_row, &sums.row_row})
      (*sum)[k] *= factor;
  }
}

}  // namespace

TextureMoments MomentsOfTexture(const uint8_t* middle,
                                int stride,
                                const ReferencePatches& patches,
                                const ParallaxDirections& directions,
                                float noise_variance) {
  TextureMoments sums;
  const float noise = 2.0F * noise_variance;  // of the difference of two levels
  LaneFloats low;
  LaneFloats high;
  size_t pair = 0;
  for (int row = -kPatchRadius_px; row <= kPatchRadius_px; row += 2) {
    for (int column = -kPatchRadius_px; column < kPatchRadius_px; column += 4, ++pair) {
      for (size_t k = 0; k < kMatchLanes; ++k) {
        low[k] = static_cast<float>(patches.weights[pair][k] & 0xFFFF);
        high[k] = static_cast<float>(patches.weights[pair][k] >> 16);
      }
      const uint8_t* const tap = middle + row * stride + column;
      AddTap(tap, stride, row, column, low, directions, noise, sums);
      AddTap(tap + 2, stride, row, column + 2, high, directions, noise, sums);
    }
  }
  DivideByTexture(sums);
  return sums;
}

float FreeSlopeVariance(const TextureMoments& moments,
                        size_t lane,
                        float variance_px2,
                        float slope) {
  const float c = moments.column[lane];
  const float r = moments.row[lane];
  const float cc = moments.column_column[lane] - c * c;
  const float rr = moments.row_row[lane] - r * r;
  const float cr = moments.column_row[lane] - c * r;
  // Along the two axes of the second moments.
  const float mean = 0.5F * (cc + rr);
  const float half = 0.5F * (cc - rr);
  const float apart = std::sqrt(half * half + cr * cr);
  const float away = c * c + r * r;
  const float turned = apart > 1e-6F ? (half * (c * c - r * r) + 2.0F * cr * c * r) / apart : away;
  const float loose = variance_px2 / (slope * slope);
  const float wide = std::max(mean + apart - kBlur_px2, 0.0F) + loose;
  const float narrow = std::max(mean - apart - kBlur_px2, 0.0F) + loose;
  const float lever = 0.5F * ((away + turned) / wide + (away - turned) / narrow);
  return variance_px2 * (1.0F + std::max(lever, 0.0F));
}

}  // namespace orbweave
