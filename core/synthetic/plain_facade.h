// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/synthetic/facade_look.h"
#include "core/synthetic/texture.h"

namespace orbweave {

/// A wall as most towns have them: even plaster (or bricks of one tone) whose grain is a few
/// hundredths of its brightness, windows of one make in rows, plinth, string course, cornice and
/// downpipe; at street level a shop, a gateway, doors and windows. Proportions and colours follow
/// from `seed`.
[[nodiscard]] SurfaceColour PlainFacade(const TexturePoint& point,
                                        uint32_t seed,
                                        const FacadeLook& look);

}  // namespace orbweave
