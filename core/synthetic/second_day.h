// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/synthetic/street_world.h"

namespace orbweave {

/// The same street on another day: houses, poles, trees and hedges stand where they stood; the sun
/// has another direction, the sky other clouds, the shops other wares, and other cars are parked.
[[nodiscard]] StreetWorld SecondDayOf(const StreetWorld& first, uint64_t seed);

}  // namespace orbweave
