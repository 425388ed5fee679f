// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/simulate_gnss.h"

#include <cmath>
#include <numbers>
#include <string>

#include "core/base/random.h"

namespace orbweave {
namespace {

Eigen::Vector3d HorizontalVector(double length_m, Random& random) {
  const double azimuth = random.Uniform(0.0, 2.0 * std::numbers::pi);
  return {length_m * std::cos(azimuth), length_m * std::sin(azimuth), 0.0};
}

/// The error that stays, at each position.
std::vector<Eigen::Vector3d> Multipath(const std::vector<Eigen::Vector3d>& truth,
                                       const GnssModel& model,
                                       Random random) {
  const Eigen::Vector3d sigma_m = model.multipath_m * Eigen::Vector3d(1.0, 1.0, 1.5);
  std::vector<Eigen::Vector3d> errors;
  errors.reserve(truth.size());
  for (size_t i = 0; i < truth.size(); ++i) {
    const Eigen::Vector3d fresh(random.Normal(), random.Normal(), random.Normal());
    const double kept =
        i == 0 ? 0.0 : std::exp(-(truth[i] - truth[i - 1]).norm() / model.multipath_length_m);
    const Eigen::Vector3d before = i == 0 ? Eigen::Vector3d::Zero().eval() : errors.back();
    errors.push_back(kept * before + std::sqrt(1.0 - kept * kept) * sigma_m.cwiseProduct(fresh));
  }
  return errors;
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
  if (model.multipath_m == 0.0) return measured;
  const std::vector<Eigen::Vector3d> errors =
      Multipath(truth, model, Random("multipath/" + std::to_string(seed)));
  for (size_t i = 0; i < measured.size(); ++i) measured[i] += errors[i];
  return measured;
}

}  // namespace orbweave
