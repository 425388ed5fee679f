// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/find_gravity.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

constexpr double kMaxDeviation_rad = 30.0 * std::numbers::pi / 180.0;
constexpr int kIterations = 20;  // of Weiszfeld's

}  // namespace

std::optional<Eigen::Vector3d> FindGravity(const Reconstruction& reconstruction) {
  std::vector<Eigen::Vector3d> downs;
  for (const auto& [id, image] : reconstruction.images) {
    if (image.loose) continue;
    downs.push_back(image.cam_from_world.rotation.conjugate() * Eigen::Vector3d::UnitY());
  }
  Eigen::Vector3d median = Eigen::Vector3d::Zero();
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double total = 0.0;
    for (const Eigen::Vector3d& down : downs) {
      const double weight = iteration == 0 ? 1.0 : 1.0 / std::max((down - median).norm(), 1e-3);
      sum += weight * down;
      total += weight;
    }
    if (total > 0.0) median = sum / total;
  }
  if (!(median.norm() > 0.0)) return std::nullopt;
  std::vector<double> deviations;
  for (const Eigen::Vector3d& down : downs) deviations.push_back(AngleBetween(down, median));
  if (Quantile(std::move(deviations), 0.5) > kMaxDeviation_rad) return std::nullopt;
  return median.normalized();
}

Eigen::Quaterniond UprightFromDown(const Eigen::Vector3d& down) {
  return RotationBetween(down, -Eigen::Vector3d::UnitZ());
}

}  // namespace orbweave
