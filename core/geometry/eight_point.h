// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace orbweave {

/// Essential matrix of eight or more pairs of unit bearings: the least singular vector of
/// p_b^T E p_a = 0, then the nearest matrix with singular values (1, 1, 0); the paper's solver
/// (3.3). Hartley and Zisserman, Multiple View Geometry, 2003, algorithm 11.1 (unit bearings need
/// no normalisation). nullopt for fewer than eight pairs and for configurations that do not
/// determine E (equal bearings, pure rotation, one plane).
[[nodiscard]] std::optional<Eigen::Matrix3d> SolveEightPoint(
    std::span<const Eigen::Vector3d> bearings_a, std::span<const Eigen::Vector3d> bearings_b);

}  // namespace orbweave
