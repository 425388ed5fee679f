// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/place_pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace orbweave {
namespace {

/// One keypoint described twice, or found at two scales.
constexpr double kSameSpotRad = 0.5 * std::numbers::pi / 180.0;

}  // namespace

int PlacePairs::CellOf(const Eigen::Vector3d& bearing) {
  const auto index = [](double x) {
    return std::clamp(static_cast<int>(std::floor(x / kReachRad)) + kSide / 2, 1, kSide - 2);
  };
  return (index(bearing.z()) * kSide + index(bearing.y())) * kSide + index(bearing.x());
}

bool PlacePairs::Add(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  constexpr double kSameSquared = kSameSpotRad * kSameSpotRad;
  constexpr double kReachSquared = kReachRad * kReachRad;
  const int cell = CellOf(a);
  size_t near = 0;
  for (int k = 0; k < 27; ++k) {
    const int neighbour = cell + ((k / 9 - 1) * kSide + k / 3 % 3 - 1) * kSide + k % 3 - 1;
    for (int32_t i = last_of_cell_[static_cast<size_t>(neighbour)]; i != kNone;
         i = before_[static_cast<size_t>(i)]) {
      const Match& other = counted_[static_cast<size_t>(i)];
      const double squared = std::max((other.a - a).squaredNorm(), (other.b - b).squaredNorm());
      if (squared < kSameSquared) return false;
      if (squared < kReachSquared && ++near == kMatchesOfAThing) return false;
    }
  }
  before_.push_back(std::exchange(last_of_cell_[static_cast<size_t>(cell)],
                                  static_cast<int32_t>(counted_.size())));
  counted_.push_back({a, b});
  return true;
}

}  // namespace orbweave
