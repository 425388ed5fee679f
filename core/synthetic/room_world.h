// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/synthetic/street_world.h"

namespace orbweave {

/// A closed room 2.7 m high, 1.4 m wider on every side than a loop of `length_m` (at least 12 m)
/// that a camera is carried round 1.5 m above the floor: even walls with pictures, a wooden floor,
/// and furniture along the walls and in the middle. Its frame: origin in the middle of the loop,
/// x along its longer side, z up, the camera about z = 0.
[[nodiscard]] StreetWorld MakeRoomWorld(double length_m, uint64_t seed);

}  // namespace orbweave
