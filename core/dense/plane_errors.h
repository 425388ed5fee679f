// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace orbweave {

/// How far off a fitted plane may be, across itself.
struct PlaneErrors {
  float relief_m = 0.0F;  ///< of the surface about the plane (ReliefOf)
  float fit_m = 0.0F;     ///< sigma of the plane in the middle of its points
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  /// Two axes of the plane, each divided by how far its points spread along it.
  Eigen::Matrix<float, 2, 3> axes = Eigen::Matrix<float, 2, 3>::Zero();

  /// One sigma, at a point of the plane: it is known worse away from its points.
  [[nodiscard]] float SigmaAt(const Eigen::Vector3f& point) const {
    const float away = (axes * (point - middle)).squaredNorm();
    return std::sqrt(relief_m * relief_m + fit_m * fit_m * (1.0F + away));
  }
};

}  // namespace orbweave
