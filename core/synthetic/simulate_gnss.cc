// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/simulate_gnss.h"

#include <cmath>
#include <numbers>

#include "core/base/random.h"

namespace orbweave {
namespace {

Eigen::Vector3d HorizontalVector(double length_m, Random& random) {
  const double azimuth = random.Uniform(0.0, 2.0 * std::numbers::pi);
  return {length_m * std::cos(azimuth), length_m * std::sin(azimuth), 0.0};
}

}  // namespace

std::vector<Eigen::Vector3d> SimulateGnss(const std::vector<Eigen::Vector3d>& truth,
                                          const GnssModel& model,
                                          uint64_t seed) {
  Random random(seed);
  const Eigen::Vector3d bias = HorizontalVector(model.bias_m, random);
  std::vector<Eigen::Vector3d> measured;
  measured.reserve(truth.size());
  for (const Eigen::Vector3d& position : truth) {
    const double east = model.sigma_m * random.Normal();
    const double north = model.sigma_m * random.Normal();
    const double up = 1.5 * model.sigma_m * random.Normal();
    const bool outlier = random.Uniform() < model.outlier_share;
    const Eigen::Vector3d jump = HorizontalVector(random.Uniform(15.0, 60.0), random);
    measured.push_back(position + bias + Eigen::Vector3d(east, north, up));
    if (outlier) measured.back() += jump;
  }
  return measured;
}

}  // namespace orbweave
