// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/planar_grid.h"

#include <algorithm>
#include <cmath>

namespace orbweave {
namespace {

/// Cells of one column are neighbours in the order of keys, so that a query is one run per column.
uint64_t KeyOf(int64_t column, int64_t row) {
  constexpr int64_t kOffset = int64_t{1} << 31;
  return (static_cast<uint64_t>(column + kOffset) << 32) | static_cast<uint64_t>(row + kOffset);
}

}  // namespace

PlanarGrid::PlanarGrid(const std::vector<Eigen::Vector2d>& positions, double cell_m)
    : cell_m_(cell_m) {
  cells_.reserve(positions.size());
  for (uint32_t i = 0; i < positions.size(); ++i) {
    cells_.emplace_back(KeyOf(CellOf(positions[i].x()), CellOf(positions[i].y())), i);
  }
  std::sort(cells_.begin(), cells_.end());
  positions_.reserve(positions.size());
  for (const auto& [key, index] : cells_) positions_.push_back(positions[index]);
}

int64_t PlanarGrid::CellOf(double coordinate_m) const {
  return static_cast<int64_t>(std::floor(coordinate_m / cell_m_));
}

std::vector<uint32_t> PlanarGrid::Within(const Eigen::Vector2d& centre, double radius_m) const {
  std::vector<uint32_t> found;
  const int64_t row_low = CellOf(centre.y() - radius_m);
  const int64_t row_high = CellOf(centre.y() + radius_m);
  const int64_t column_high = CellOf(centre.x() + radius_m);
  for (int64_t column = CellOf(centre.x() - radius_m); column <= column_high; ++column) {
    const uint64_t last = KeyOf(column, row_high);
    auto it = std::lower_bound(
        cells_.begin(), cells_.end(), std::pair{KeyOf(column, row_low), uint32_t{0}});
    for (; it != cells_.end() && it->first <= last; ++it) {
      const auto slot = static_cast<size_t>(it - cells_.begin());
      if ((positions_[slot] - centre).squaredNorm() <= radius_m * radius_m) {
        found.push_back(it->second);
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace orbweave
