// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/random.h"
#include "core/synthetic/solid.h"
#include "core/synthetic/street_layout.h"

namespace orbweave {

/// Body and cabin of a car that stands along the street, `left_m` to the left of its axis.
void AppendCar(const PathPlace& place, double left_m, Random& random, std::vector<Solid>& solids);

/// Whether the axis is straight for the length of a car.
[[nodiscard]] bool IsStraightAt(const StreetLayout& layout, double station_m);

}  // namespace orbweave
