// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/image_manifest.h"

namespace orbweave {

/// How the model's coordinates relate to the earth: origin, axes and unit of the east-north-up
/// frame, and the matrix from it to earth-centred coordinates (EPSG:4978). Without an origin:
/// "georeferenced": false. `models`: those that have this frame, N of sparse/N; others are free.
[[nodiscard]] std::string GeoreferenceJson(const ImageManifest& manifest,
                                           const std::vector<uint32_t>& models);

}  // namespace orbweave
