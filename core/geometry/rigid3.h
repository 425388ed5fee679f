// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace orbweave {

/// Rigid motion `b_from_a`: point_in_b = rotation * point_in_a + translation. Chains read like
/// cancelling fractions: `c_from_a = c_from_b * b_from_a`. Metres where the frame is metric.
struct Rigid3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  /// Origin of frame b in frame a: for `cam_from_world`, the camera centre C = -R^T t in the world.
  [[nodiscard]] Eigen::Vector3d Centre() const { return -(rotation.conjugate() * translation); }
  [[nodiscard]] Rigid3 Inverse() const { return {rotation.conjugate(), Centre()}; }

  /// The pose with rotation R and centre C.
  [[nodiscard]] static Rigid3 FromCentre(const Eigen::Quaterniond& R, const Eigen::Vector3d& C) {
    return {R, -(R * C)};
  }
};

inline Eigen::Vector3d operator*(const Rigid3& b_from_a, const Eigen::Vector3d& point_in_a) {
  return b_from_a.rotation * point_in_a + b_from_a.translation;
}

inline Rigid3 operator*(const Rigid3& c_from_b, const Rigid3& b_from_a) {
  return {(c_from_b.rotation * b_from_a.rotation).normalized(),
          c_from_b.rotation * b_from_a.translation + c_from_b.translation};
}

}  // namespace orbweave
