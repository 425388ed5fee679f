// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/upright_solid.h"

#include "core/synthetic/street_layout.h"

namespace orbweave {

Solid UprightSolid(SolidKind kind,
                   const Eigen::Vector2d& middle,
                   const Eigen::Vector2d& along,
                   const Eigen::Vector3d& size_m,
                   double base_m,
                   Random& random) {
  return {.kind = kind,
          .centre = {middle.x(), middle.y(), kStreetGround_m + base_m + size_m.z() / 2.0},
          .half = size_m / 2.0,
          .along = along,
          .seed = static_cast<uint32_t>(random.Next() >> 32)};
}

}  // namespace orbweave
