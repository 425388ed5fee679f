// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/synthetic/texture.h"

namespace orbweave {

/// Sides with wheels and doors; front and back with lamps and a number plate. Faces as in solid.h.
[[nodiscard]] SurfaceColour CarBody(const TexturePoint& p, int face, uint32_t seed);

/// Panes between pillars, and a roof.
[[nodiscard]] SurfaceColour CarCabin(const TexturePoint& p, int face, uint32_t seed);

/// A bus or van: a band of panes above painted panels; lamps, plate and a poster behind.
[[nodiscard]] SurfaceColour Bus(const TexturePoint& p, int face, uint32_t seed);

/// Part of a person: one colour with folds, or skin and hair where it is small enough for a head.
/// `local` is the point in the solid's own axes.
[[nodiscard]] Colour Clothes(const Eigen::Vector3d& local,
                             double height_m,
                             double pixel_m,
                             uint32_t seed);

}  // namespace orbweave
