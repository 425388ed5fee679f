// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

namespace orbweave {

/// Points of the plane sorted into square cells: neighbours within a radius without looking at
/// all of them. Memory is 16 bytes per point.
class PlanarGrid {
 public:
  /// `cell_m` > 0: about the radius that will be asked for. Positions within 2^31 cells of zero.
  PlanarGrid(const std::vector<Eigen::Vector2d>& positions, double cell_m);

  /// Indices of the points no farther than `radius_m` from `centre`, ascending.
  [[nodiscard]] std::vector<uint32_t> Within(const Eigen::Vector2d& centre, double radius_m) const;

 private:
  [[nodiscard]] int64_t CellOf(double coordinate_m) const;

  std::vector<Eigen::Vector2d> positions_;            // in the order of cells_
  std::vector<std::pair<uint64_t, uint32_t>> cells_;  // (cell key, index of the point), sorted
  double cell_m_;
};

}  // namespace orbweave
