// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/scene/features.h"
#include "core/synthetic/street.h"

namespace orbweave {

/// Points of the surface of what stands still.
struct SurfaceSamples {
  std::vector<Eigen::Vector3d> points_in_enu{};
  std::vector<Rgb> colors{};
};

/// The points that a raster of `columns` x `columns / 2` rays meets from the true place of
/// panorama i: exact to rounding, dense where the camera is near.
[[nodiscard]] SurfaceSamples SampleSurface(const Street& street, size_t i, int columns);

/// Binary little-endian PLY: float32 x y z, uint8 red green blue.
[[nodiscard]] std::string PlyFromSamples(const SurfaceSamples& samples);

}  // namespace orbweave
