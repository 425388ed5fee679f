// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "absl/container/inlined_vector.h"

namespace orbweave {

/// Essential matrices, |E| = sqrt(2), with p_b^T E p_a = 0 for five pairs of unit bearings of any
/// directions on the sphere: at most ten. Nister, An efficient solution to the five-point relative
/// pose problem, PAMI 2004: the null space of the five equations, the ten cubics det E = 0 and 2 E
/// E^T E = tr(E E^T) E, elimination to a polynomial of degree ten. Degenerate samples give matrices
/// without meaning or none, never NaN.
[[nodiscard]] absl::InlinedVector<Eigen::Matrix3d, 10> SolveFivePoint(
    std::span<const Eigen::Vector3d, 5> bearings_a, std::span<const Eigen::Vector3d, 5> bearings_b);

}  // namespace orbweave
