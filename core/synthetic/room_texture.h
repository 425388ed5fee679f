// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/synthetic/solid.h"
#include "core/synthetic/texture.h"

namespace orbweave {

/// What a room is made of: even plaster, boards of a floor, furniture with doors, drawers and
/// books, pictures in frames.
[[nodiscard]] Colour RoomColour(SolidKind kind, const TexturePoint& p, int face, uint32_t seed);

}  // namespace orbweave
