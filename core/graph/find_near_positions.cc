// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/find_near_positions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace orbweave {
namespace {

using Cell = std::pair<int64_t, int64_t>;

Cell CellOf(const Eigen::Vector2d& position, double width) {
  return {std::llround(std::floor(position.x() / width)),
          std::llround(std::floor(position.y() / width))};
}

struct Neighbour {
  double distance = 0.0;
  uint32_t index = 0;
  friend auto operator<=>(const Neighbour&, const Neighbour&) = default;
};

}  // namespace

std::vector<std::vector<uint32_t>> FindNearPositions(std::span<const Eigen::Vector2d> positions,
                                                     double radius,
                                                     size_t max_neighbours) {
  std::vector<std::vector<uint32_t>> near(positions.size());
  if (radius <= 0.0) return near;

  std::map<Cell, std::vector<uint32_t>> grid;
  for (uint32_t i = 0; i < positions.size(); ++i) grid[CellOf(positions[i], radius)].push_back(i);

  std::vector<Neighbour> found;
  for (uint32_t i = 0; i < positions.size(); ++i) {
    found.clear();
    const Cell centre = CellOf(positions[i], radius);
    for (int64_t x = centre.first - 1; x <= centre.first + 1; ++x) {
      for (int64_t y = centre.second - 1; y <= centre.second + 1; ++y) {
        const auto cell = grid.find({x, y});
        if (cell == grid.end()) continue;
        for (const uint32_t j : cell->second) {
          const double distance = (positions[i] - positions[j]).norm();
          if (j != i && distance <= radius) found.push_back({distance, j});
        }
      }
    }
    const size_t kept = std::min(found.size(), max_neighbours);
    std::partial_sort(found.begin(), found.begin() + static_cast<ptrdiff_t>(kept), found.end());
    for (size_t n = 0; n < kept; ++n) near[i].push_back(found[n].index);
  }
  return near;
}

}  // namespace orbweave
