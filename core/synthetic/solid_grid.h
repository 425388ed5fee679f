// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/synthetic/solid.h"

namespace orbweave {

/// Nearest of the solids along a ray.
struct GridHit {
  SolidHit hit{};
  uint32_t solid = 0;  ///< index; meaningless when the distance is infinite
};

/// Solids sorted into the square cells of a plan that they overlap; a ray looks only at the cells
/// it crosses. Amanatides and Woo: A fast voxel traversal algorithm, Eurographics 1987.
class SolidGrid {
 public:
  SolidGrid() = default;
  explicit SolidGrid(const std::vector<Solid>& solids);

  /// Nearest hit before `max_distance_m`; of equal distances the smaller index.
  [[nodiscard]] GridHit Nearest(const LightRay& ray, double max_distance_m) const;
  /// Whether anything is hit at all.
  [[nodiscard]] bool IsHit(const LightRay& ray) const;

 private:
  /// Column and row of a place relative to `low_`, clamped to the grid.
  [[nodiscard]] Eigen::Vector2i CellOf(const Eigen::Vector2d& from_low) const;
  /// Calls visit(solid, distance at which the cell ends) for the solids of each cell along the ray,
  /// then visit(none, the same) at the cell's end, until a call returns true.
  template <typename Visitor>
  void Walk(const LightRay& ray, double max_distance_m, Visitor&& visit) const;

  std::vector<Solid> solids_{};
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int columns_ = 0;
  int rows_ = 0;
  std::vector<uint32_t> first_{};    // cell -> first index in members_; one more at the end
  std::vector<uint32_t> members_{};  // solids by cell, ascending
};

}  // namespace orbweave
