// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/scene/image_manifest.h"

namespace orbweave {

/// WGS84 position of a point of the east-north-up frame (metres) that touches the ellipsoid's
/// normal at `origin`: east-north-up -> earth-centred -> geodetic by Bowring's iteration, exact to
/// well below a millimetre at street heights. Not meant for points above the poles.
[[nodiscard]] GeodeticPosition GeodeticFromEnu(const GeodeticPosition& origin,
                                               const Eigen::Vector3d& position_in_enu);

}  // namespace orbweave
