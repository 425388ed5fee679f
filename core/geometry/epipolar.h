// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/geometry/rigid3.h"

namespace orbweave {

/// Equation (7): angle in radians between the bearing p_b and the epipolar plane of p_a, whose
/// normal is E p_a / |E p_a|; in [0, pi/2]. pi/2 where p_a is the epipole and has no plane.
[[nodiscard]] double EpipolarAngle(const Eigen::Matrix3d& E,
                                   const Eigen::Vector3d& p_a,
                                   const Eigen::Vector3d& p_b);

/// The same in both images at once, the angle e with 1/sin^2 e = (1/sin^2 e_a + 1/sin^2 e_b) / 2:
/// equal to (7) where both images agree, and to sqrt(2) times the first-order (Sampson) distance on
/// the spheres. Near an epipole, where noise turns the plane, the better of the two images decides.
/// |T| = 1; p_a, p_b unit.
[[nodiscard]] double SymmetricEpipolarAngle(const Rigid3& b_from_a,
                                            const Eigen::Vector3d& p_a,
                                            const Eigen::Vector3d& p_b);

/// Cheirality on both spheres (paper 3.3): whether the point nearest to the two rays lies in front
/// of both, p . (R P + T) > 0. False for parallel rays.
[[nodiscard]] bool IsInFrontOfBoth(const Rigid3& b_from_a,
                                   const Eigen::Vector3d& p_a,
                                   const Eigen::Vector3d& p_b);

}  // namespace orbweave
