// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/dense/panorama_raster.h"
#include "core/scene/features.h"

namespace orbweave {

/// Colour of a panorama in the direction of a non-zero vector of the camera frame: bilinear between
/// the middles of pixels, columns periodic; grey images give grey, an image without pixels black.
[[nodiscard]] Rgb ColorAlong(const PanoramaRaster& image, const Eigen::Vector3d& bearing);

}  // namespace orbweave
