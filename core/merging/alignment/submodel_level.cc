// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/submodel_level.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr size_t kFewestCameras = 10;
/// Cosine of 18 degrees: cameras on a carrier that lean by so much still agree.
constexpr double kMinAgreement = 0.95;
constexpr double kSlopes_rad = 3.0 * kRadPerDeg;
constexpr double kLossScale_rad = 2.0 * kRadPerDeg;
constexpr int kReweightings = 10;

}  // namespace

std::optional<SubmodelLevel> LevelOf(std::span<const Rigid3> cams_from_submodel) {
  std::vector<Vector3d> ups;
  Vector3d mean = Vector3d::Zero();
  for (const Rigid3& cam_from_submodel : cams_from_submodel) {
    ups.emplace_back(cam_from_submodel.rotation.conjugate() * -Vector3d::UnitY());
    mean += ups.back();
  }
  if (ups.size() < kFewestCameras) return std::nullopt;
  if (mean.norm() < kMinAgreement * static_cast<double>(ups.size())) return std::nullopt;
  mean.normalize();
  const CauchyLoss loss(kLossScale_rad);
  for (int round = 0; round < kReweightings; ++round) {
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& up : ups) {
      const double away_rad = AngleBetween(up, mean);
      sum += loss.Weight(away_rad * away_rad) * up;
    }
    mean = sum.normalized();
  }
  std::vector<double> leans_rad;
  for (const Vector3d& up : ups) leans_rad.push_back(AngleBetween(up, mean));
  return SubmodelLevel{.up = mean,
                       .sigma_rad = std::hypot(kSlopes_rad, Quantile(std::move(leans_rad), 0.5))};
}

}  // namespace orbweave
