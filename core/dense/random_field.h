// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/dense/patch_match_round.h"
#include "core/dense/plane_field.h"
#include "core/dense/reference_raster.h"

namespace orbweave {

/// A field of planes that face the camera at random ranges; where `ranges_m` (face_px^2 x 6, 0:
/// unknown) has one, at that range.
[[nodiscard]] PlaneField RandomField(const ReferenceRaster& raster,
                                     const RangeLimits& limits,
                                     const std::vector<float>& ranges_m,
                                     uint64_t seed);

/// Each pixel takes the plane of the pixel that covers it at half the size.
[[nodiscard]] PlaneField DoubleField(const PlaneField& half);

}  // namespace orbweave
