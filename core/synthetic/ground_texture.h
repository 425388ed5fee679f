// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/synthetic/street_layout.h"
#include "core/synthetic/texture.h"

namespace orbweave {

/// The ground at a place of the street's frame: asphalt with patches, manholes and lane marks
/// between two kerbs, slabs beyond them. `footprint_m` is the longer extent of the pixel;
/// `contrast` is the share that is left of grain, slabs and patches, not of marks and manholes.
[[nodiscard]] Colour GroundColour(const StreetLayout& layout,
                                  const Eigen::Vector2d& place,
                                  double footprint_m,
                                  uint32_t seed,
                                  double contrast = 1.0);

}  // namespace orbweave
