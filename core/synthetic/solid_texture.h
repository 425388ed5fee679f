// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/synthetic/solid.h"
#include "core/synthetic/texture.h"

namespace orbweave {

/// Colour and glass of a solid at a point of its surface that is seen by a pixel covering `pixel_m`
/// across the ray of unit direction `direction`.
[[nodiscard]] SurfaceColour LookOfSolid(const Solid& solid,
                                        int face,
                                        const Eigen::Vector3d& point,
                                        const Eigen::Vector3d& direction,
                                        double pixel_m);

}  // namespace orbweave
