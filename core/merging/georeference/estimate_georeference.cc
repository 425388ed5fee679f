// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/estimate_georeference.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/base/random.h"
#include "core/base/status.h"
#include "core/estimators/estimate_similarity.h"
#include "core/geometry/rotation.h"
#include "core/merging/georeference/find_gravity.h"
#include "core/merging/georeference/refine_georeference.h"

namespace orbweave {
namespace {

constexpr int kTrials = 500;

// Yaw, scale and translation from two pairs of an upright model; nullopt when either is one point.
std::optional<Sim3> UprightFromTwo(const GnssPositions& upright, uint32_t i, uint32_t j) {
  const Eigen::Vector2d a = (upright.in_world[j] - upright.in_world[i]).head<2>();
  const Eigen::Vector2d b = (upright.in_enu[j] - upright.in_enu[i]).head<2>();
  if (!(a.norm() > 0.0) || !(b.norm() > 0.0)) return std::nullopt;
  const double yaw = std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x());
  Sim3 enu_from_world;
  enu_from_world.scale = b.norm() / a.norm();
  enu_from_world.rotation = RotationFromVector({0.0, 0.0, yaw});
  const Eigen::Vector3d middle = 0.5 * (upright.in_world[i] + upright.in_world[j]);
  enu_from_world.translation =
      0.5 * (upright.in_enu[i] + upright.in_enu[j]) - enu_from_world * middle;
  return enu_from_world;
}

// Of known heights; where none is, of those that stand in for them.
double MedianHeightError(const GnssPositions& positions, const Sim3& enu_from_world) {
  std::vector<double> known;
  std::vector<double> unknown;
  for (size_t i = 0; i < positions.size(); ++i) {
    (positions.KnowsHeight(i) ? known : unknown)
        .push_back((enu_from_world * positions.in_world[i] - positions.in_enu[i]).z());
  }
  return Quantile(known.empty() ? std::move(unknown) : std::move(known), 0.5);
}

}  // namespace

double HorizontalCost(const GnssPositions& positions, const Sim3& enu_from_world) {
  double cost = 0.0;
  for (size_t i = 0; i < positions.size(); ++i) {
    const Eigen::Vector3d residual = enu_from_world * positions.in_world[i] - positions.in_enu[i];
    cost += std::min(9.0, residual.cwiseQuotient(positions.sigma_m[i]).head<2>().squaredNorm());
  }
  return cost;
}

GnssPositions Turned(const Eigen::Quaterniond& rotation, GnssPositions positions) {
  const Sim3 turn{1.0, rotation, Eigen::Vector3d::Zero()};
  for (Eigen::Vector3d& point : positions.in_world) point = turn * point;
  return positions;
}

absl::StatusOr<std::optional<Sim3>> EstimateUpright(const GnssPositions& upright,
                                                    const StageContext& context) {
  Random random(context.seed);
  std::optional<Sim3> best;
  double best_cost = 0.0;
  const auto n = static_cast<uint32_t>(upright.size());
  for (int trial = 0; trial < kTrials; ++trial) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    const uint32_t i = random.Index(n);
    const uint32_t j = (i + 1 + random.Index(n - 1)) % n;
    const std::optional<Sim3> candidate = UprightFromTwo(upright, i, j);
    if (!candidate) continue;
    const double cost = HorizontalCost(upright, *candidate);
    if (best && cost >= best_cost) continue;
    best = candidate;
    best_cost = cost;
  }
  if (best) best->translation.z() -= MedianHeightError(upright, *best);
  return best;
}

absl::StatusOr<std::optional<Sim3>> EstimateLevel(const GnssPositions& positions,
                                                  const Gravity& gravity,
                                                  const StageContext& context) {
  const Sim3 upright_from_world{
      1.0, UprightFromDown(gravity.down_in_world), Eigen::Vector3d::Zero()};
  const GnssPositions upright = Turned(upright_from_world.rotation, positions);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::optional<Sim3> start, EstimateUpright(upright, context));
  if (!start) return std::optional<Sim3>();
  return std::optional<Sim3>(*start * upright_from_world);
}

bool LeansTooFar(const Gravity& gravity, const Sim3& enu_from_world) {
  return AngleBetween(enu_from_world.rotation * gravity.down_in_world, -Eigen::Vector3d::UnitZ()) >
         kMaxLean_rad;
}

absl::StatusOr<std::optional<Sim3>> EstimateGeoreference(const GnssPositions& positions,
                                                         const std::optional<Gravity>& gravity,
                                                         const StageContext& context) {
  if (!gravity) {
    const double max_error_m = 3.0 * positions.MedianSigma_m();
    ORBWEAVE_ASSIGN_OR_RETURN(
        const std::optional<RobustSimilarity> robust,
        EstimateSimilarity(positions.in_world, positions.in_enu, max_error_m, context));
    if (!robust) return std::optional<Sim3>();
    return std::optional<Sim3>(
        RefineGeoreference(positions.Pairs(), gravity, 1.0, robust->b_from_a));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::optional<Sim3> start,
                            EstimateLevel(positions, *gravity, context));
  if (!start) return std::optional<Sim3>();
  // No mount leans so far: something else is wrong with the heights, and shows better from upright.
  const Sim3 refined = RefineGeoreference(positions.Pairs(), gravity, 1.0, *start);
  return std::optional<Sim3>(LeansTooFar(*gravity, refined) ? *start : refined);
}

}  // namespace orbweave
