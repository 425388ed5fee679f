// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/geometry/rigid3.h"

namespace orbweave {

/// Similarity `b_from_a`: point_in_b = scale * (rotation * point_in_a) + translation, scale > 0.
struct Sim3 {
  double scale = 1.0;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  [[nodiscard]] Sim3 Inverse() const {
    const Eigen::Quaterniond R = rotation.conjugate();
    return {1.0 / scale, R, -(R * translation) / scale};
  }
};

inline Eigen::Vector3d operator*(const Sim3& b_from_a, const Eigen::Vector3d& point_in_a) {
  return b_from_a.scale * (b_from_a.rotation * point_in_a) + b_from_a.translation;
}

inline Sim3 operator*(const Sim3& c_from_b, const Sim3& b_from_a) {
  return {c_from_b.scale * b_from_a.scale,
          (c_from_b.rotation * b_from_a.rotation).normalized(),
          c_from_b.scale * (c_from_b.rotation * b_from_a.translation) + c_from_b.translation};
}

/// The camera pose in frame b of a camera known in frame a. Scale moves the centre and leaves the
/// rotation: R_b = R_a R^T, C_b = s R C_a + t.
inline Rigid3 TransformCamera(const Sim3& b_from_a, const Rigid3& cam_from_a) {
  return Rigid3::FromCentre((cam_from_a.rotation * b_from_a.rotation.conjugate()).normalized(),
                            b_from_a * cam_from_a.Centre());
}

}  // namespace orbweave
