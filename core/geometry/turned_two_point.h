// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "core/geometry/rigid3.h"

namespace orbweave {

/// The pose b_from_a, |T| = 1, of which the rotation R is known, from two pairs of unit bearings:
/// T is at right angles to both (R p_a) x p_b, with the sign that has the first point in front of
/// both cameras where one has. nullopt where both pairs lie in one plane with T.
[[nodiscard]] std::optional<Rigid3> SolveTurnedTwoPoint(
    const Eigen::Quaterniond& rotation,
    std::span<const Eigen::Vector3d, 2> bearings_a,
    std::span<const Eigen::Vector3d, 2> bearings_b);

}  // namespace orbweave
