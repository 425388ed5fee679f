// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/geometry/rigid3.h"

namespace orbweave {

/// Angle between predicted ray and observed bearing, radians.
[[nodiscard]] double BearingError(const Rigid3& cam_from_world,
                                  const Eigen::Vector3d& point_in_world,
                                  const Eigen::Vector3d& bearing);

}  // namespace orbweave
