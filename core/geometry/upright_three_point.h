// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "absl/container/inlined_vector.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

/// Poses b_from_a, |T| = 1, of two upright panoramas (gravity along the y axis of both cameras)
/// from three pairs of unit bearings: R turns about y, and T . (R p_a x p_b) = 0 three times. With
/// the tangent of half the angle the determinant of the three normals is (1 + s^2) times a quartic.
/// At most four rotations, one sign of T each (the other three poses of the essential matrix are
/// not listed). Fraundorfer, Tanskanen, Pollefeys: A minimal case solution to the calibrated
/// relative pose problem for the case of two known orientation angles, ECCV 2010. Empty for
/// degenerate samples.
[[nodiscard]] absl::InlinedVector<Rigid3, 4> SolveUprightThreePoint(
    std::span<const Eigen::Vector3d, 3> bearings_a, std::span<const Eigen::Vector3d, 3> bearings_b);

}  // namespace orbweave
