// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/surface_point.h"

namespace orbweave {

/// Positions of the dense cloud are whole multiples of this.
inline constexpr double kPositionQuantum_m = 0.0005;

/// The nearest position whose coordinates are multiples of kPositionQuantum_m.
[[nodiscard]] Eigen::Vector3d QuantisedPosition(const Eigen::Vector3d& position);

/// A square column of the world's x-y plane; the cell (0, 0) has its lower corner at the origin.
struct TileCell {
  int64_t x = 0;
  int64_t y = 0;
  friend auto operator<=>(const TileCell&, const TileCell&) = default;
};

/// Divides the world into square columns. Positions and the cell's size count as multiples of the
/// quantum, so that which cell a point lies in is a matter of whole numbers.
struct TileGrid {
  double cell_m = 8.0;  ///< at least the quantum; rounded to a multiple of it

  /// `position`: quantised, within 1e12 m of the origin.
  [[nodiscard]] TileCell CellOf(const Eigen::Vector3d& position) const;
};

/// A run of points that lie in one tile.
struct TileRun {
  TileCell cell{};
  size_t begin = 0;
  size_t count = 0;
};

/// Sorts points by tile, then by position, then by the rest: the same order however they came. The
/// runs follow in order of cells.
[[nodiscard]] std::vector<TileRun> GroupByTile(const TileGrid& grid,
                                               std::vector<SurfacePoint>& points);

}  // namespace orbweave
