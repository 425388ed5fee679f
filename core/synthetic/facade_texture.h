// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/synthetic/facade_look.h"
#include "core/synthetic/texture.h"

namespace orbweave {

/// A wall of a house: plaster or brick with noise and stains of its own at every scale, floors of
/// equal windows (the repetition that misleads matching), and a ground floor of doors, shop
/// windows, posters and lettered signs that tells houses apart. Proportions and colours follow
/// from `seed`.
[[nodiscard]] SurfaceColour FacadeSurface(const TexturePoint& point,
                                          uint32_t seed,
                                          const FacadeLook& look = {});

}  // namespace orbweave
