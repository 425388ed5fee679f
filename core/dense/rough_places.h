// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/dense/find_planes.h"

namespace orbweave {

/// Entry plane, then (face * cells + row) * cells + column, cells = face_px / 2: 1 where it is
/// rough.
using RoughPlaces = std::vector<std::vector<uint8_t>>;

/// Where a plane is but a slab cut out of something rough, as the crown of a tree: there, many
/// pixels that match well lie beside it, within four tolerances, or on it with another normal. A
/// plane is rough in a cell of 2 x 2 pixels if those within six cells are more than half as many as
/// those on it, and at least 200 (of few, some are wrong).
[[nodiscard]] RoughPlaces FindRoughPlaces(int face_px,
                                          const std::vector<ReliablePoint>& points,
                                          const std::vector<FittedPlane>& planes);

}  // namespace orbweave
