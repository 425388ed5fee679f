// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/synthetic/texture.h"

namespace orbweave {

/// The sky in a unit direction of the world (z up) for pixels of `pixel_rad`: hills on the horizon
/// and clouds, both at infinity. Hills follow from `seed`, clouds from `seed` and `clouds`; `drift`
/// is the way that the clouds have gone, in their heights.
[[nodiscard]] Colour SkyColour(const Eigen::Vector3d& direction,
                               double pixel_rad,
                               uint32_t seed,
                               uint32_t clouds = 0,
                               const Eigen::Vector2d& drift = Eigen::Vector2d::Zero());

}  // namespace orbweave
