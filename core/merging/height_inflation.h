// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/geometry/sim3.h"
#include "core/merging/estimate_gravity.h"
#include "core/merging/gnss_track.h"

namespace orbweave {

/// So many heights of GNSS - positions along the ground where no height is known, as hills tell a
/// tilt by them - are worth one independent one, as far as a model that was fitted to them tells
/// (EstimatePositionNoise; positions further off than 99 % of normal ones would be take no part).
/// `positions_in_enu`: of the fixes of all drives one after the other, without what is known to be
/// wrong of them. Between 1, also where there are too few to tell, and their number. Linear in the
/// fixes.
[[nodiscard]] double HeightInflation(std::span<const GnssDrive> drives,
                                     std::span<const Eigen::Vector3d> positions_in_enu,
                                     const std::optional<Gravity>& gravity,
                                     const Sim3& enu_from_world);

}  // namespace orbweave
