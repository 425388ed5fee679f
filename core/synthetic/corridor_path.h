// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/synthetic/corridor.h"
#include "core/synthetic/street_path.h"

namespace orbweave {

/// Where the panoramas of a corridor are taken, in order.
[[nodiscard]] std::vector<PathPlace> CorridorPlaces(const CorridorOptions& options);

}  // namespace orbweave
