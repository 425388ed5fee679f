// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "absl/container/inlined_vector.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

/// Poses cam_from_world with lambda_i b_i = R P_i + T, lambda_i > 0, from three unit bearings of
/// any directions on the sphere and three points: at most four.
///
/// The distances lambda satisfy three quadrics lambda_i^2 + lambda_j^2 - 2 lambda_i lambda_j
/// b_i.b_j = |P_i - P_j|^2. Two homogeneous conics in lambda follow; a degenerate member of their
/// pencil is a pair of lines, each of which meets a conic in two points. Ding, Yang, Larsson,
/// Olsson, Astrom: Revisiting the P3P problem, CVPR 2023; Persson and Nordberg: Lambda twist, ECCV
/// 2018. Empty when the points are collinear or no distances are real and positive.
[[nodiscard]] absl::InlinedVector<Rigid3, 4> SolveP3p(
    std::span<const Eigen::Vector3d, 3> bearings,
    std::span<const Eigen::Vector3d, 3> points_in_world);

}  // namespace orbweave
