// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/residual_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbweave {
namespace {

constexpr double kSignificant = 6.0;  // standard deviations of a mean

}  // namespace

void ResidualPattern::Add(const Eigen::Vector3d& bearing,
                          const Eigen::Vector3d& ray,
                          double px_per_rad) {
  const double azimuth = std::atan2(bearing.x(), bearing.z());
  const double turns = azimuth / (2.0 * std::numbers::pi) + 0.5;
  const size_t sector = std::min(kSectors - 1, static_cast<size_t>(turns * kSectors));
  const Eigen::Vector3d sideways(std::cos(azimuth), 0.0, -std::sin(azimuth));
  sum_px[sector] += px_per_rad * sideways.dot(bearing - ray);
  ++count[sector];
}

void ResidualPattern::Add(const ResidualPattern& other) {
  for (size_t s = 0; s < kSectors; ++s) {
    sum_px[s] += other.sum_px[s];
    count[s] += other.count[s];
  }
}

double ResidualPattern::LargestPx(double rms_px) const {
  double largest = 0.0;
  for (size_t s = 0; s < kSectors; ++s) {
    if (count[s] == 0) continue;
    const double mean_px = std::abs(sum_px[s]) / count[s];
    if (mean_px * std::sqrt(count[s]) > kSignificant * rms_px) largest = std::max(largest, mean_px);
  }
  return largest;
}

}  // namespace orbweave
