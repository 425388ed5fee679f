// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/scene/image_manifest.h"

namespace orbweave {

/// How the model's coordinates relate to the earth: origin, axes and unit of the east-north-up
/// frame, and the matrix from it to earth-centred coordinates (EPSG:4978). Without an origin:
/// "georeferenced": false.
[[nodiscard]] std::string GeoreferenceJson(const ImageManifest& manifest, bool georeferenced);

}  // namespace orbweave
