// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/place_pairs.h"

#include <algorithm>
#include <cmath>

namespace orbweave {
namespace {

/// One keypoint described twice, or found at two scales.
constexpr double kSameSpotRad = 0.5 * std::numbers::pi / 180.0;

}  // namespace

PlacePairs::Cell PlacePairs::CellOf(const Eigen::Vector3d& bearing) {
  const auto index = [](double x) { return static_cast<int>(std::floor(x / kReachRad)); };
  return {index(bearing.x()), index(bearing.y()), index(bearing.z())};
}

bool PlacePairs::Add(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Cell cell = CellOf(a);
  size_t near = 0;
  for (int k = 0; k < 27; ++k) {
    const auto found =
        cells_.find({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
    if (found == cells_.end()) continue;
    for (const size_t i : found->second) {
      const double distance = std::max((counted_[i].a - a).norm(), (counted_[i].b - b).norm());
      if (distance < kSameSpotRad) return false;
      if (distance < kReachRad && ++near == kMatchesOfAThing) return false;
    }
  }
  cells_[cell].push_back(counted_.size());
  counted_.push_back({a, b});
  return true;
}

}  // namespace orbweave
