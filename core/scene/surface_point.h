// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/scene/features.h"

namespace orbweave {

/// A sample of a surface, as the dense stage gives them out.
struct SurfacePoint {
  Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3f normal_in_world = Eigen::Vector3f::UnitZ();  ///< unit, towards who saw it
  Rgb color{};
  float sigma_m = 0.0F;  ///< of the position along the ray that saw it
  uint8_t views = 0;     ///< panoramas that bear it out

  friend bool operator==(const SurfacePoint&, const SurfacePoint&) = default;
};

}  // namespace orbweave
