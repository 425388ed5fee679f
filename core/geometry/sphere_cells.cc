// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/sphere_cells.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <numbers>
#include <numeric>

namespace orbweave {
namespace {

constexpr int kFineCells = 32;

/// Index in {0, ..., n-1} of a share in [0, 1] (or just outside, from rounding).
uint32_t Bin(double share, int n) {
  return static_cast<uint32_t>(std::clamp(static_cast<int>(std::floor(share * n)), 0, n - 1));
}

}  // namespace

uint32_t SphereCell(const Eigen::Vector3d& bearing, int n) {
  const double longitude_share =
      std::atan2(bearing.x(), bearing.z()) / (2.0 * std::numbers::pi) + 0.5;
  return Bin(0.5 * (bearing.y() + 1.0), n) * static_cast<uint32_t>(n) + Bin(longitude_share, n);
}

double SphereSpread(std::span<const Eigen::Vector3d> bearings) {
  std::bitset<size_t{kSpreadCells} * kSpreadCells> taken;
  for (const Eigen::Vector3d& bearing : bearings) taken.set(SphereCell(bearing, kSpreadCells));
  return static_cast<double>(taken.count()) / static_cast<double>(taken.size());
}

PlacesAround CountPlacesAround(std::span<const Eigen::Vector3d> bearings) {
  std::bitset<size_t{kFineCells} * kFineCells> taken;
  for (const Eigen::Vector3d& bearing : bearings) taken.set(SphereCell(bearing, kFineCells));
  std::array<uint32_t, kFineCells> of_sector{};
  for (size_t cell = 0; cell < taken.size(); ++cell)
    of_sector[cell % kFineCells] += taken.test(cell) ? 1U : 0U;
  PlacesAround places{.all = static_cast<uint32_t>(taken.count())};
  constexpr size_t kHalf = kFineCells / 2;
  uint32_t half = std::accumulate(of_sector.begin(), of_sector.begin() + kHalf, 0U);
  places.of_emptier_half = half;
  for (size_t sector = 0; sector < kFineCells; ++sector) {
    half += of_sector[(sector + kHalf) % kFineCells];
    half -= of_sector[sector];
    places.of_emptier_half = std::min(places.of_emptier_half, half);
  }
  return places;
}

}  // namespace orbweave
