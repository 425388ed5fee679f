// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/synthetic/corridor_options.h"
#include "core/synthetic/corridor_path.h"

namespace orbweave {

/// The ground under a corridor: waves to the east and to the north, so that streets that cross meet
/// at one height,
///   h = g / (k sqrt 2) (sin(k x) + sin(k y)) - h_0,   k = 2 pi / hill_length_m,
/// nowhere steeper than g = hill_grade. The median of the panoramas' places is at height zero, as a
/// reader of their GNSS positions has it.
class CorridorTerrain {
 public:
  CorridorTerrain(const CorridorOptions& options, const CorridorPath& path);

  [[nodiscard]] double HeightAt(const Eigen::Vector2d& plan) const;
  /// Metres up per metre along `direction`, unit.
  [[nodiscard]] double SlopeAt(const Eigen::Vector2d& plan, const Eigen::Vector2d& direction) const;

 private:
  double grade_;
  double wave_;  // rad / m
  double height_of_median_m_ = 0.0;
};

}  // namespace orbweave
