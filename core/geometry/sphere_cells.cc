// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/sphere_cells.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <numbers>

namespace orbweave {
namespace {

constexpr int kFinest = 1 << kVisibilityLevels;

/// Index in {0, ..., n-1} of a share in [0, 1] (or just outside, from rounding).
uint32_t Bin(double share, int n) {
  return static_cast<uint32_t>(std::clamp(static_cast<int>(std::floor(share * n)), 0, n - 1));
}

size_t CountCells(std::span<const Eigen::Vector3d> bearings, int n) {
  std::bitset<kFinest * kFinest> taken;
  for (const Eigen::Vector3d& bearing : bearings) taken.set(SphereCell(bearing, n));
  return taken.count();
}

}  // namespace

uint32_t SphereCell(const Eigen::Vector3d& bearing, int n) {
  const double longitude_share =
      std::atan2(bearing.x(), bearing.z()) / (2.0 * std::numbers::pi) + 0.5;
  return Bin(0.5 * (bearing.y() + 1.0), n) * static_cast<uint32_t>(n) + Bin(longitude_share, n);
}

double SphereSpread(std::span<const Eigen::Vector3d> bearings) {
  return static_cast<double>(CountCells(bearings, kSpreadCells)) / (kSpreadCells * kSpreadCells);
}

double SphereVisibility(std::span<const Eigen::Vector3d> bearings) {
  double score = 0.0;
  double full = 0.0;
  for (int n = 2; n <= kFinest; n *= 2) {
    const double weight = static_cast<double>(n) * n;
    score += weight * static_cast<double>(CountCells(bearings, n));
    full += weight * weight;
  }
  return score / full;
}

}  // namespace orbweave
