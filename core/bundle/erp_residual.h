// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/bundle/bearing_residual.h"

namespace orbweave {

/// The paper's residual (5), (11): the difference between the predicted ray u = R (X - C) / |X - C|
/// and the observed unit `bearing` in the equirectangular image, as an angle,
///   r = (longitude(u) - longitude(bearing), latitude(u) - latitude(bearing)),
/// longitude atan2(x, z), latitude asin(y), the difference of longitudes the short way round the
/// seam. Times W / 2pi it is in pixels; over a sigma of 2pi / W, too. To first order it is the
/// residual of EvaluateBearingResidual with its component along the parallel over cos(latitude).
/// The pole has no longitude: its derivative is bounded where the ray is within 0.06 degrees of it.
/// X = C: everything is zero.
[[nodiscard]] BearingResidual EvaluateErpResidual(const Eigen::Matrix3d& R,
                                                  const Eigen::Vector3d& centre_in_world,
                                                  const Eigen::Vector3d& point_in_world,
                                                  const Eigen::Vector3d& bearing);

}  // namespace orbweave
