// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace orbweave {

/// For every position the at most `max_neighbours` nearest others within `radius` (closed), nearest
/// first, ties in index order. A grid of cells as wide as the radius: linear time where density is
/// bounded. All empty for a radius of 0 or less.
[[nodiscard]] std::vector<std::vector<uint32_t>> FindNearPositions(
    std::span<const Eigen::Vector2d> positions, double radius, size_t max_neighbours);

}  // namespace orbweave
