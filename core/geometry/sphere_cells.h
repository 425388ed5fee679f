// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

namespace orbweave {

constexpr int kSpreadCells = 8;  ///< bands and sectors of `SphereSpread`

/// Cell of a unit bearing in a division of the sphere into n x n cells of equal area (Archimedes:
/// bands of equal height in y, sectors of equal longitude): band * n + sector, in [0, n^2).
[[nodiscard]] uint32_t SphereCell(const Eigen::Vector3d& bearing, int n);

/// Share of the 8 x 8 cells that hold a bearing, 0 ... 1.
[[nodiscard]] double SphereSpread(std::span<const Eigen::Vector3d> bearings);

/// How bearings lie around an upright camera, in 32 x 32 cells of SphereCell.
struct PlacesAround {
  uint32_t all = 0;              ///< cells that hold a bearing
  uint32_t of_emptier_half = 0;  ///< of them in that half of the horizon that has fewest
};

[[nodiscard]] PlacesAround CountPlacesAround(std::span<const Eigen::Vector3d> bearings);

}  // namespace orbweave
