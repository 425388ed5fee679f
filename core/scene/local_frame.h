// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/scene/image_manifest.h"

namespace orbweave {

/// East, north, up (metres) of a WGS84 position in the tangent frame at `origin`. Exact (through
/// geocentric coordinates), any distance. Karney, GeographicLib::LocalCartesian.
[[nodiscard]] Eigen::Vector3d EnuFromGeodetic(const GeodeticPosition& position,
                                              const GeodeticPosition& origin);

/// The inverse of EnuFromGeodetic.
[[nodiscard]] GeodeticPosition GeodeticFromEnu(const Eigen::Vector3d& point_in_enu,
                                               const GeodeticPosition& origin);

}  // namespace orbweave
