// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/bearing_error.h"

#include "core/geometry/rotation.h"

namespace orbweave {

double BearingError(const Rigid3& cam_from_world,
                    const Eigen::Vector3d& point_in_world,
                    const Eigen::Vector3d& bearing) {
  return AngleBetween(cam_from_world * point_in_world, bearing);
}

}  // namespace orbweave
