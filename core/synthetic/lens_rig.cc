// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/lens_rig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace orbweave {
namespace {

std::array<Eigen::Vector3d, 6> MakeAxes() {
  std::array<Eigen::Vector3d, 6> axes;
  for (size_t k = 0; k < 5; ++k) {
    const double azimuth = 2.0 * std::numbers::pi * static_cast<double>(k) / 5.0;
    axes[k] = {std::sin(azimuth), 0.0, std::cos(azimuth)};
  }
  axes[5] = {0.0, -1.0, 0.0};
  return axes;
}

}  // namespace

Eigen::Vector3d LensRig::AxisFor(const Eigen::Vector3d& bearing) {
  static const std::array<Eigen::Vector3d, 6> kAxes = MakeAxes();
  size_t nearest = 0;
  for (size_t k = 1; k < kAxes.size(); ++k) {
    if (kAxes[k].dot(bearing) > kAxes[nearest].dot(bearing)) nearest = k;
  }
  return kAxes[nearest];
}

double LensRig::Gain(const Eigen::Vector3d& bearing) const {
  if (vignetting == 0.0) return 1.0;
  const double cosine = AxisFor(bearing).dot(bearing) / bearing.norm();
  return std::max(0.1, 1.0 - 2.0 * vignetting * (1.0 - cosine * cosine));
}

}  // namespace orbweave
