// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/street_layout.h"

#include <algorithm>
#include <numbers>
#include <vector>

namespace orbweave {
namespace {

constexpr double kCornerRadius_m = 6.0;
constexpr double kShortestLoop_m = 110.0;
constexpr double kAspect = 1.5;

std::vector<Eigen::Vector2d> Clockwise(const Eigen::Vector2d& half) {
  return {
      {-half.x(), half.y()}, {half.x(), half.y()}, {half.x(), -half.y()}, {-half.x(), -half.y()}};
}

}  // namespace

double StreetLayout::DistanceFromAxis(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d q = place.cwiseAbs() - half_m + Eigen::Vector2d::Constant(kCornerRadius_m);
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - kCornerRadius_m;
}

StreetLayout MakeStreetLayout(double length_m) {
  // Rounding four corners shortens the rectangle's perimeter by (8 - 2 pi) r.
  const double perimeter_m =
      std::max(length_m, kShortestLoop_m) + (8.0 - 2.0 * std::numbers::pi) * kCornerRadius_m;
  const double half_height_m = perimeter_m / (4.0 * (1.0 + kAspect));
  const Eigen::Vector2d half(kAspect * half_height_m, half_height_m);
  return {half, StreetPath(Clockwise(half), kCornerRadius_m, true)};
}

}  // namespace orbweave
