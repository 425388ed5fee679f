// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/halve_rows.h"

#include <cmath>

namespace orbweave::internal {
namespace {

/// Columns that the cubic reads beyond both ends.
constexpr int kApron = 2;

/// Weights of the neighbours at -1, 0, 1, 2 for the position t in [0, 1).
std::array<float, kHalvingTaps> CubicWeights(double t) {
  return {static_cast<float>(0.5 * t * (-1.0 + t * (2.0 - t))),
          static_cast<float>(1.0 + 0.5 * t * t * (-5.0 + 3.0 * t)),
          static_cast<float>(0.5 * t * (1.0 + t * (4.0 - 3.0 * t))),
          static_cast<float>(0.5 * t * t * (-1.0 + t))};
}

}  // namespace

int RowHalver::FirstSource(int row) const {
  return static_cast<int>(std::floor(Position(row))) - 1;
}

std::array<float, kHalvingTaps> RowHalver::Weights(int row) const {
  const double position = Position(row);
  return CubicWeights(position - std::floor(position));
}

ColumnHalver::ColumnHalver(int fine_width, int coarse_width)
    : fine_width_(fine_width),
      coarse_width_(coarse_width),
      halver_(fine_width, coarse_width),
      line_(static_cast<size_t>(fine_width + 2 * kApron)) {}

void ColumnHalver::Halve(const std::array<const float*, kHalvingTaps>& rows,
                         const std::array<float, kHalvingTaps>& weights,
                         float* out) {
  float* const line = line_.data() + kApron;
  // The outer and the inner pair first: a row and its mirror image give the same bits.
  for (int x = -kApron; x < fine_width_ + kApron; ++x) {
    line[x] = (rows[0][x] * weights[0] + rows[3][x] * weights[3]) +
              (rows[1][x] * weights[1] + rows[2][x] * weights[2]);
  }
  if (halver_.IsExact()) {
    const std::array<float, kHalvingTaps> w = CubicWeights(0.5);
    for (int x = 0; x < coarse_width_; ++x) {
      out[x] = (line[2 * x - 1] * w[0] + line[2 * x + 2] * w[3]) +
               (line[2 * x] * w[1] + line[2 * x + 1] * w[2]);
    }
    return;
  }
  for (int x = 0; x < coarse_width_; ++x) {
    const int first = halver_.FirstSource(x);
    const std::array<float, kHalvingTaps> w = halver_.Weights(x);
    out[x] = (line[first] * w[0] + line[first + 3] * w[3]) +
             (line[first + 1] * w[1] + line[first + 2] * w[2]);
  }
}

}  // namespace orbweave::internal
