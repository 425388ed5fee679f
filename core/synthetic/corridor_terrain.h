// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "core/synthetic/corridor_options.h"

namespace orbweave {

/// The ground under a corridor: waves to the east and to the north, so that streets that cross meet
/// at one height,
///   h = g / (k sqrt 2) (sin(k x) + sin(k y)),   k = 2 pi / hill_length_m,
/// nowhere steeper than g = hill_grade.
class CorridorTerrain {
 public:
  explicit CorridorTerrain(const CorridorOptions& options)
      : grade_(options.hill_grade), wave_(2.0 * std::numbers::pi / options.hill_length_m) {}

  [[nodiscard]] double HeightAt(const Eigen::Vector2d& plan) const {
    return grade_ / (wave_ * std::numbers::sqrt2) *
           (std::sin(wave_ * plan.x()) + std::sin(wave_ * plan.y()));
  }
  /// Metres up per metre along `direction`, unit.
  [[nodiscard]] double SlopeAt(const Eigen::Vector2d& plan,
                               const Eigen::Vector2d& direction) const {
    const Eigen::Vector2d slope(std::cos(wave_ * plan.x()), std::cos(wave_ * plan.y()));
    return grade_ / std::numbers::sqrt2 * slope.dot(direction);
  }

 private:
  double grade_;
  double wave_;  // rad / m
};

}  // namespace orbweave
