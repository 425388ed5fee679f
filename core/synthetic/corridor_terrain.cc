// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/synthetic/corridor_terrain.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/quantile.h"

namespace orbweave {

CorridorTerrain::CorridorTerrain(const CorridorOptions& options, const CorridorPath& path)
    : grade_(options.hill_grade), wave_(2.0 * std::numbers::pi / options.hill_length_m) {
  std::vector<double> heights;
  for (const CorridorStation& station : path.stations)
    heights.push_back(HeightAt(station.place.position));
  height_of_median_m_ = UpperMedian(std::move(heights));
}

double CorridorTerrain::HeightAt(const Eigen::Vector2d& plan) const {
  return grade_ / (wave_ * std::numbers::sqrt2) *
             (std::sin(wave_ * plan.x()) + std::sin(wave_ * plan.y())) -
         height_of_median_m_;
}

double CorridorTerrain::SlopeAt(const Eigen::Vector2d& plan,
                                const Eigen::Vector2d& direction) const {
  const Eigen::Vector2d slope(std::cos(wave_ * plan.x()), std::cos(wave_ * plan.y()));
  return grade_ / std::numbers::sqrt2 * slope.dot(direction);
}

}  // namespace orbweave
