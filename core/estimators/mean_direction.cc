// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/mean_direction.h"

#include <numbers>

#include "core/geometry/rotation.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr int kReweightings = 10;

}  // namespace

Eigen::Vector3d RobustMeanDirection(std::span<const Eigen::Vector3d> directions,
                                    const Eigen::Vector3d& start,
                                    double loss_scale_deg) {
  const CauchyLoss loss(loss_scale_deg);
  Eigen::Vector3d mean = start;
  for (int round = 0; round < kReweightings; ++round) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& direction : directions) {
      const double away_deg = kDegPerRad * AngleBetween(direction, mean);
      sum += loss.Weight(away_deg * away_deg) * direction;
    }
    mean = sum.normalized();
  }
  return mean;
}

}  // namespace orbweave
