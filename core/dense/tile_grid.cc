// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/tile_grid.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace orbweave {
namespace {

constexpr double kPerMetre = 2000.0;  // 1 / kPositionQuantum_m, exact

int64_t Count(double metres) { return std::llround(metres * kPerMetre); }

int64_t FloorDivide(int64_t count, int64_t size) {
  return count / size - (count % size < 0 ? 1 : 0);
}

auto Order(const SurfacePoint& point) {
  const Eigen::Vector3d& X = point.position_in_world;
  const Eigen::Vector3f& n = point.normal_in_world;
  const Rgb& color = point.color;
  return std::tuple(X.x(),
                    X.y(),
                    X.z(),
                    point.sigma_m,
                    point.views,
                    std::tuple(n.x(), n.y(), n.z()),
                    std::tuple(color.r, color.g, color.b));
}

}  // namespace

Eigen::Vector3d QuantisedPosition(const Eigen::Vector3d& position) {
  return (position * kPerMetre).array().round() / kPerMetre;
}

TileCell TileGrid::CellOf(const Eigen::Vector3d& position) const {
  const int64_t size = std::max<int64_t>(1, Count(cell_m));
  return {FloorDivide(Count(position.x()), size), FloorDivide(Count(position.y()), size)};
}

std::vector<TileRun> GroupByTile(const TileGrid& grid, std::vector<SurfacePoint>& points) {
  std::ranges::sort(points, {}, [&](const SurfacePoint& point) {
    return std::pair(grid.CellOf(point.position_in_world), Order(point));
  });
  std::vector<TileRun> runs;
  for (size_t i = 0; i < points.size(); ++i) {
    const TileCell cell = grid.CellOf(points[i].position_in_world);
    if (runs.empty() || runs.back().cell != cell) runs.push_back({cell, i, 0});
    ++runs.back().count;
  }
  return runs;
}

}  // namespace orbweave
