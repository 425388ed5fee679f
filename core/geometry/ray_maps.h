// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/geometry/rigid3.h"

namespace orbweave {

/// The rotation matrix R that maximises sum p_b . R p_a over pairs of unit bearings (Wahba's
/// problem), by SVD: Arun, Huang, Blostein, PAMI 1987. nullopt for fewer than two pairs or when all
/// bearings are parallel.
[[nodiscard]] std::optional<Eigen::Matrix3d> FitRayRotation(
    std::span<const Eigen::Vector3d> bearings_a, std::span<const Eigen::Vector3d> bearings_b);

/// The ray homography H, |H| = 1, with p_b parallel to H p_a and most of them on the same side,
/// p_b . H p_a > 0: bearings of points on one plane. Least singular vector of B_b^T H p_a = 0, B_b
/// the tangent plane of p_b; of four pairs in closed form. nullopt for fewer than four pairs, when
/// these do not determine H, and for four of which it takes some to the same and some to the
/// opposite side.
[[nodiscard]] std::optional<Eigen::Matrix3d> FitRayHomography(
    std::span<const Eigen::Vector3d> bearings_a, std::span<const Eigen::Vector3d> bearings_b);

/// The ray homography R + t n^T of a plane n . X = 1, in the frame of a, seen under a known pose
/// b_from_a = (R, t) (Faugeras, Lustman 1988): n by least squares of
/// p_b x (R p_a + t (n . p_a)) = 0. nullopt for fewer than three pairs, when these do not determine
/// the plane, and for three of which it lies behind some.
[[nodiscard]] std::optional<Eigen::Matrix3d> FitRayPlane(
    const Rigid3& b_from_a,
    std::span<const Eigen::Vector3d> bearings_a,
    std::span<const Eigen::Vector3d> bearings_b);

}  // namespace orbweave
