// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace orbweave {

/// Of a direction in the frame of an upright camera: clockwise from the axis that looks forward,
/// seen from above, radians; y points down.
[[nodiscard]] inline double AzimuthInCamera(const Eigen::Vector3d& direction) {
  return std::atan2(direction.x(), direction.z());
}

/// Heading of camera a less that of camera b, both upright, radians in no particular turn.
[[nodiscard]] inline double TurnOf(const Eigen::Quaterniond& b_from_a) {
  return AzimuthInCamera(b_from_a * Eigen::Vector3d::UnitZ());
}

/// The same azimuth in [-pi, pi].
[[nodiscard]] inline double WrappedAzimuth(double azimuth) {
  return std::remainder(azimuth, 2.0 * std::numbers::pi);
}

/// In [0, pi].
[[nodiscard]] inline double AngleBetweenAzimuths(double azimuth_a, double azimuth_b) {
  return std::abs(WrappedAzimuth(azimuth_a - azimuth_b));
}

}  // namespace orbweave
