// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/dense/depth_problem.h"

namespace orbweave {

/// Ranges of the pixels of an equiangular raster to start from: each pixel that of one of the three
/// seeds nearest to it, drawn at random, changed by up to a tenth; one pixel in eight has none (0).
/// Empty without seeds. Seeds whose range is not finite and positive are passed over.
[[nodiscard]] std::vector<float> InterpolateSeeds(std::span<const DepthSeed> seeds,
                                                  int face_px,
                                                  uint64_t seed);

}  // namespace orbweave
