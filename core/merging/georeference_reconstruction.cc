// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference_reconstruction.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

#include "core/base/random.h"
#include "core/estimators/estimate_similarity.h"
#include "core/geometry/rotation.h"
#include "core/merging/cluster_spreads.h"
#include "core/merging/find_gravity.h"
#include "core/merging/quantile.h"

namespace orbweave {
namespace {

constexpr size_t kMinPositions = 4;
constexpr int kTrials = 500;
constexpr int kReweightings = 20;
constexpr double kMaxScaleUncertainty = 0.1;
constexpr double kMinAgreeingShare = 0.7;
constexpr size_t kMinDrive = 8;
constexpr double kSigmaOfMad = 1.4826;

// Camera centres and what GNSS says of them; sigma is that of one axis, for weights.
struct Positions {
  std::vector<Eigen::Vector3d> in_world{};
  std::vector<Eigen::Vector3d> in_enu{};
  std::vector<double> sigma_m{};
  std::vector<uint32_t> drive{};

  [[nodiscard]] size_t size() const { return in_world.size(); }
};

Positions Collect(const Reconstruction& reconstruction, const ImageManifest& manifest) {
  Positions positions;
  for (const auto& [id, image] : reconstruction.images) {
    const PosePrior& prior = manifest.At(id).prior;
    if (image.loose || !prior.position_in_enu) continue;
    positions.in_world.push_back(image.cam_from_world.Centre());
    positions.in_enu.push_back(*prior.position_in_enu);
    positions.sigma_m.push_back(prior.horizontal_sigma_m);
    positions.drive.push_back(manifest.At(id).drive);
  }
  return positions;
}

// Yaw, scale and translation from two pairs of an upright model; nullopt when either is one point.
std::optional<Sim3> UprightFromTwo(const Positions& upright, uint32_t i, uint32_t j) {
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

// Sum of squared residuals in sigmas, each 9 (three sigmas) at most.
double TruncatedCost(const Positions& positions, const Sim3& enu_from_world) {
  double cost = 0.0;
  for (size_t i = 0; i < positions.size(); ++i) {
    const Eigen::Vector3d residual = enu_from_world * positions.in_world[i] - positions.in_enu[i];
    cost += std::min(9.0, residual.squaredNorm() / (positions.sigma_m[i] * positions.sigma_m[i]));
  }
  return cost;
}

absl::StatusOr<std::optional<Sim3>> EstimateUpright(const Positions& upright,
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
    const double cost = TruncatedCost(upright, *candidate);
    if (best && cost >= best_cost) continue;
    best = candidate;
    best_cost = cost;
  }
  return best;
}

// Two further pairs, up and down from the middle by the extent, that tilt costs as much as
// kGravitySigma_rad once.
void AddGravity(const Eigen::Vector3d& down,
                const Sim3& enu_from_world,
                Positions& positions,
                std::vector<double>& weights) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : positions.in_world) middle += point;
  middle /= static_cast<double>(positions.size());
  const Eigen::Vector3d middle_in_enu = enu_from_world * middle;
  const double extent = SpreadOf(positions.in_world).rms;
  const double extent_m = enu_from_world.scale * extent;
  for (const double side : {-1.0, 1.0}) {
    positions.in_world.push_back(middle + side * extent * down);
    positions.in_enu.push_back(middle_in_enu - side * extent_m * Eigen::Vector3d::UnitZ());
    weights.push_back(0.5 / std::pow(extent_m * kGravitySigma_rad, 2));
  }
}

// Seven parameters with Cauchy weights; the start when the fit is degenerate.
Sim3 Refine(const Positions& positions,
            const std::optional<Eigen::Vector3d>& down,
            Sim3 enu_from_world) {
  for (int iteration = 0; iteration < kReweightings; ++iteration) {
    std::vector<double> weights;
    for (size_t i = 0; i < positions.size(); ++i) {
      const double squared_sigma = positions.sigma_m[i] * positions.sigma_m[i];
      const Eigen::Vector3d residual = enu_from_world * positions.in_world[i] - positions.in_enu[i];
      weights.push_back(1.0 / (squared_sigma + residual.squaredNorm()));
    }
    Positions with_gravity = positions;
    if (down) AddGravity(*down, enu_from_world, with_gravity, weights);
    const std::optional<Sim3> fit =
        FitSimilarity(with_gravity.in_world, with_gravity.in_enu, weights);
    if (!fit) break;
    enu_from_world = *fit;
  }
  return enu_from_world;
}

absl::StatusOr<std::optional<Sim3>> Estimate(const Positions& positions,
                                             const std::optional<Eigen::Vector3d>& down,
                                             const StageContext& context) {
  if (!down) {
    const double max_error_m = 3.0 * Quantile(positions.sigma_m, 0.5);
    ORBWEAVE_ASSIGN_OR_RETURN(
        const std::optional<RobustSimilarity> robust,
        EstimateSimilarity(positions.in_world, positions.in_enu, max_error_m, context));
    if (!robust) return std::optional<Sim3>();
    return std::optional<Sim3>(Refine(positions, down, robust->b_from_a));
  }
  const Sim3 upright_from_world{1.0, UprightFromDown(*down), Eigen::Vector3d::Zero()};
  Positions upright = positions;
  for (Eigen::Vector3d& point : upright.in_world) point = upright_from_world * point;
  ORBWEAVE_ASSIGN_OR_RETURN(const std::optional<Sim3> start, EstimateUpright(upright, context));
  if (!start) return std::optional<Sim3>();
  return std::optional<Sim3>(Refine(positions, down, *start * upright_from_world));
}

// Model minus GNSS, without the bias (median) of each drive that is long enough to have one.
std::vector<Eigen::Vector3d> Residuals(const Positions& positions, const Sim3& enu_from_world) {
  std::vector<Eigen::Vector3d> residuals;
  std::map<uint32_t, std::vector<size_t>> members;
  for (size_t i = 0; i < positions.size(); ++i) {
    residuals.push_back(enu_from_world * positions.in_world[i] - positions.in_enu[i]);
    members[positions.drive[i]].push_back(i);
  }
  for (const auto& [drive, indices] : members) {
    if (members.size() == 1 || indices.size() < kMinDrive) continue;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (const size_t i : indices) values.push_back(residuals[i][axis]);
      const double bias = Quantile(std::move(values), 0.5);
      for (const size_t i : indices) residuals[i][axis] -= bias;
    }
  }
  return residuals;
}

void MeasureScatter(const std::vector<Eigen::Vector3d>& residuals, Georeference& result) {
  std::vector<double> horizontal;
  std::vector<double> vertical;
  for (const Eigen::Vector3d& residual : residuals) {
    horizontal.push_back(std::abs(residual.x()));
    horizontal.push_back(std::abs(residual.y()));
    vertical.push_back(std::abs(residual.z()));
  }
  // The fit has taken seven of the 3n degrees of freedom.
  const auto n = static_cast<double>(residuals.size());
  const double sigma_of_median = kSigmaOfMad * std::sqrt(3.0 * n / (3.0 * n - 7.0));
  result.horizontal_scatter_m = sigma_of_median * Quantile(std::move(horizontal), 0.5);
  result.vertical_scatter_m = sigma_of_median * Quantile(std::move(vertical), 0.5);
}

// Share of the positions within three sigmas of the model, horizontally.
double AgreeingShare(const std::vector<Eigen::Vector3d>& residuals, double scatter_m) {
  const auto agreeing =
      std::count_if(residuals.begin(), residuals.end(), [&](const Eigen::Vector3d& residual) {
        return residual.head<2>().norm() <= 3.0 * scatter_m;
      });
  return static_cast<double>(agreeing) / static_cast<double>(residuals.size());
}

std::string Metres(double value_m) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f m", value_m);
  return text;
}

// Measures the scatter and drops the similarity when GNSS cannot carry its scale.
void Judge(const Positions& positions, Georeference& result) {
  const std::vector<Eigen::Vector3d> residuals = Residuals(positions, *result.enu_from_world);
  MeasureScatter(residuals, result);
  const double extent_m = result.enu_from_world->scale * SpreadOf(positions.in_world).rms;
  const double scatter_m = result.horizontal_scatter_m;
  result.scale_uncertainty =
      scatter_m / (extent_m * std::sqrt(static_cast<double>(positions.size())));
  const bool carries_scale =
      scatter_m < extent_m && result.scale_uncertainty <= kMaxScaleUncertainty;
  const double agreeing_share = AgreeingShare(residuals, scatter_m);
  if (carries_scale && agreeing_share >= kMinAgreeingShare) return;
  result.enu_from_world.reset();
  result.reason = carries_scale ? std::to_string(std::lround(100.0 * agreeing_share)) +
                                      " % of the GNSS positions agree with the model: too few"
                                : "GNSS scatters by " + Metres(scatter_m) +
                                      " about a model that would extend over " + Metres(extent_m) +
                                      ": too much to carry its scale";
}

}  // namespace

absl::StatusOr<Georeference> GeoreferenceReconstruction(const Reconstruction& reconstruction,
                                                        const ImageManifest& manifest,
                                                        GnssUse use,
                                                        const StageContext& context) {
  Georeference result;
  if (use == GnssUse::kOff) {
    result.reason = "switched off";
    return result;
  }
  const Positions positions = Collect(reconstruction, manifest);
  if (positions.size() < kMinPositions) {
    result.reason = positions.size() == 0 ? "no image has a GNSS position"
                                          : std::to_string(positions.size()) +
                                                " images with a GNSS position are too few";
    return result;
  }
  const std::optional<Eigen::Vector3d> down = FindGravity(reconstruction);
  ORBWEAVE_ASSIGN_OR_RETURN(result.enu_from_world, Estimate(positions, down, context));
  if (!result.enu_from_world) {
    result.reason = "no similarity fits the GNSS positions to the model";
    return result;
  }
  Judge(positions, result);
  return result;
}

}  // namespace orbweave
