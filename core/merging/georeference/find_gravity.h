// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/geometry/sim3.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// Unit vector down in the world, the geometric median of the panoramas' y axes: panoramas are
/// upright on average. nullopt when they are not (median deviation above 30 degrees) or there are
/// none.
[[nodiscard]] std::optional<Eigen::Vector3d> FindGravity(const Reconstruction& reconstruction);

/// The smallest rotation that turns `down` to -z.
[[nodiscard]] Eigen::Quaterniond UprightFromDown(const Eigen::Vector3d& down);

}  // namespace orbweave
