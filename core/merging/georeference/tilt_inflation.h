// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/geometry/sim3.h"
#include "core/merging/georeference/estimate_gravity.h"
#include "core/merging/georeference/gnss_track.h"

namespace orbweave {

/// By how much less positions know of a model's tilt than if their errors were independent
/// (EstimatePositionNoise). Heights tell it, and, of a model with hills, places along the ground:
/// claimed is I_z + I_xy, with the inflations f of either I_z / f_z + I_xy / f_xy is left, and the
/// answer is their ratio, about the axis that heights know least of (a street's own). Where no
/// height is known it is that of the ground. Positions further off than 99 % of normal ones would
/// be take no part. `positions_in_enu`: of the fixes of all drives one after the other, without
/// what is known to be wrong of them. Between 1, also where there are too few to tell, and their
/// number. Linear in the fixes.
[[nodiscard]] double TiltInflation(std::span<const GnssDrive> drives,
                                   std::span<const Eigen::Vector3d> positions_in_enu,
                                   const std::optional<Gravity>& gravity,
                                   const Sim3& enu_from_world);

}  // namespace orbweave
