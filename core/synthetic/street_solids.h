// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/random.h"
#include "core/synthetic/solid.h"
#include "core/synthetic/street_hardships.h"
#include "core/synthetic/street_layout.h"

namespace orbweave {

/// What stands along the street: houses on both sides with fixtures on their walls, lamp posts,
/// trees, hedges and parked cars.
[[nodiscard]] std::vector<Solid> MakeStreetSolids(const StreetLayout& layout,
                                                  uint64_t seed,
                                                  const StreetHardships& hardships = {});

/// The cars that happen to drive near `station_m` while that panorama is taken.
[[nodiscard]] std::vector<Solid> MakeMovingCars(const StreetLayout& layout,
                                                double station_m,
                                                Random& random);

}  // namespace orbweave
