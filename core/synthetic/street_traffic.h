// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/random.h"
#include "core/synthetic/solid.h"
#include "core/synthetic/street_hardships.h"
#include "core/synthetic/street_layout.h"

namespace orbweave {

/// People on both pavements, a few crossing, and vehicles in both lanes that happen to be near
/// `station_m` while that panorama is taken; none within 3 m of the camera.
[[nodiscard]] std::vector<Solid> MakePassers(const StreetLayout& layout,
                                             double station_m,
                                             const StreetHardships& hardships,
                                             Random& random);

/// The bus whose rear stays 5 m ahead of the camera; the same one at every station.
[[nodiscard]] Solid MakeBusAhead(const StreetLayout& layout, double station_m);

}  // namespace orbweave
