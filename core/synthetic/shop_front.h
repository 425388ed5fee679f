// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/synthetic/texture.h"

namespace orbweave {

/// The wall, or before it a board with letters 2.75 to 3.4 m above the ground: black-on-colour
/// blocks on a 5 x 7 raster, other ones for every `id`. `x` is the distance from the board's axis.
[[nodiscard]] Colour ShopSign(
    const Colour& wall, double x, const TexturePoint& p, double half_width_m, uint32_t id);

/// Light and dark, warm and cold shapes of all sizes: goods behind glass, posters.
[[nodiscard]] Colour Motley(const TexturePoint& p, uint32_t id);

}  // namespace orbweave
