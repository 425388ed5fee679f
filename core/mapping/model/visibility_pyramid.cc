// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/visibility_pyramid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbweave {
namespace {

constexpr uint32_t CellsPerSide(int level) { return 2U << level; }

/// The cell of `level` that holds the finest cell `cell`.
uint32_t CoarseCell(uint8_t cell, int level) {
  const uint32_t shrink = VisibilityPyramid::kFinest / CellsPerSide(level);
  const uint32_t row = cell / VisibilityPyramid::kFinest / shrink;
  const uint32_t column = cell % VisibilityPyramid::kFinest / shrink;
  return row * CellsPerSide(level) + column;
}

int Bin(double unit_interval) {
  return std::clamp(static_cast<int>(std::floor(unit_interval * VisibilityPyramid::kFinest)),
                    0,
                    VisibilityPyramid::kFinest - 1);
}

}  // namespace

uint8_t VisibilityPyramid::CellOf(const Eigen::Vector3d& bearing) {
  const double longitude = std::atan2(bearing.x(), bearing.z()) / (2.0 * std::numbers::pi) + 0.5;
  const double height = (bearing.y() + 1.0) / 2.0;  // equal height is equal area (Archimedes)
  return static_cast<uint8_t>(Bin(height) * kFinest + Bin(longitude));
}

void VisibilityPyramid::Add(uint8_t cell) {
  ++count_;
  for (int level = 0; level < kLevels; ++level) {
    const uint32_t K = CellsPerSide(level);
    if (counts_[level][CoarseCell(cell, level)]++ == 0) score_ += K * K;
  }
}

void VisibilityPyramid::Remove(uint8_t cell) {
  --count_;
  for (int level = 0; level < kLevels; ++level) {
    const uint32_t K = CellsPerSide(level);
    if (--counts_[level][CoarseCell(cell, level)] == 0) score_ -= K * K;
  }
}

}  // namespace orbweave
