// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/equirectangular_camera.h"

namespace orbweave {

using PixelCurve = std::vector<Eigen::Vector2d>;

/// The great circle arc from the unit bearing `from` along the unit tangent `along` (orthogonal to
/// it) over `length_rad`, as curves in the panorama: a point each half a degree, cut where it
/// crosses the seam so that no two neighbours of a curve are half the width apart. Columns may
/// leave [0, W) by less than the step beyond a cut, so that both parts reach the border.
[[nodiscard]] std::vector<PixelCurve> SphereCurve(const EquirectangularCamera& camera,
                                                  const Eigen::Vector3d& from,
                                                  const Eigen::Vector3d& along,
                                                  double length_rad);

}  // namespace orbweave
