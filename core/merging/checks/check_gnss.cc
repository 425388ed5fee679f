// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_gnss.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>

#include "core/geometry/symmetric_eigen.h"
#include "core/merging/georeference/gnss_track.h"
#include "core/merging/georeference/gnss_variance.h"
#include "core/merging/georeference/scene_lean.h"

namespace orbweave {
namespace {

constexpr double kDeg = 180.0 / std::numbers::pi;
// A roll known to this needs no assumption: roads bank as much.
constexpr double kToldTilt_rad = 3.0 / kDeg;
// Streets bank and ground falls to the side by some per cent; from here on mounts are to blame.
constexpr double kMaxLean_rad = 5.0 / kDeg;
constexpr double kSharper = 2.0;  // planes there than upright

CrossCheck CheckCorrelation(const GlobalProblem& problem, const GnssVariance& variance) {
  const PositionNoise& noise = variance.noise;
  const double inflation = std::max(noise.horizontal.inflation, noise.vertical.inflation);
  const auto count = static_cast<double>(problem.bundle.position_priors.size());
  char text[200];
  std::snprintf(text,
                sizeof(text),
                "%.0f GNSS positions are worth %.1f independent ones; sigmas allow for it",
                count,
                std::max(count / inflation, 1.0));
  return {.name = "gnss_correlation", .value = inflation, .unit = "count", .sentence = text};
}

// The way of a model that runs straight, and how well anything but attitudes holds its roll.
struct Straightness {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  double gnss_sigma_rad = 0.0;  ///< of the roll about the axis
};

Straightness MeasureStraightness(const GlobalProblem& problem, const GnssVariance& variance) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double sigma_m = 0.0;
  const std::vector<PositionPrior>& priors = problem.bundle.position_priors;
  const auto count = static_cast<double>(priors.size());
  for (const PositionPrior& prior : priors) {
    middle += problem.bundle.cams_from_world[prior.pose].Centre().head<2>() / count;
    sigma_m = std::max(sigma_m, prior.sigma_m.z());
  }
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const PositionPrior& prior : priors) {
    const Eigen::Vector2d at =
        problem.bundle.cams_from_world[prior.pose].Centre().head<2>() - middle;
    scatter += at * at.transpose();
  }
  const SymmetricEigen<2> spread = EigenOf<2>(scatter);
  const double breadth_m = std::sqrt(std::max(spread.values[0], 1e-12));
  Straightness straightness;
  straightness.axis << spread.vectors.col(1), 0.0;
  straightness.gnss_sigma_rad = sigma_m * std::sqrt(variance.factors.z()) / breadth_m;
  return straightness;
}

// Sigma of down that attitudes give all together.
double AttitudeSigma_rad(const GlobalProblem& problem) {
  double information = 0.0;
  for (const DirectionPrior& prior : problem.bundle.direction_priors)
    information += 1.0 / (prior.sigma_rad * prior.sigma_rad);
  return information > 0.0 ? 1.0 / std::sqrt(information) : 1e9;
}

std::optional<CrossCheck> CheckMountTilt(const GlobalProblem& problem,
                                         const GnssVariance& variance,
                                         std::span<const Eigen::Vector3d> points_about) {
  const Straightness straightness = MeasureStraightness(problem, variance);
  const double attitude_rad = AttitudeSigma_rad(problem);
  if (std::min(straightness.gnss_sigma_rad, attitude_rad) < kToldTilt_rad) return std::nullopt;
  CrossCheck check{.name = "mount_tilt", .limit = kDeg * kMaxLean_rad, .unit = "deg"};
  char text[400];
  const std::optional<SceneLean> lean = MeasureSceneLean(points_about, straightness.axis);
  if (lean && std::abs(lean->lean_rad) > kMaxLean_rad && lean->sharpness > kSharper) {
    check.value = kDeg * std::abs(lean->lean_rad);
    check.level = CheckLevel::kDoubtful;
    std::snprintf(text,
                  sizeof(text),
                  "ground and walls of the model lean by %.0f degrees about the way: the mount of "
                  "the cameras leans, and a straight street does not tell GNSS so. Give pitch and "
                  "roll of the panoramas, or a drive that turns",
                  check.value);
  } else {
    const bool is_upright = lean && std::abs(lean->lean_rad) <= kMaxLean_rad;
    check.value = is_upright ? kDeg * std::abs(lean->lean_rad) : 0.0;
    std::snprintf(text,
                  sizeof(text),
                  "the way is too straight to tell how far the cameras lean to the side: taken as "
                  "upright within %.1f degrees%s",
                  kDeg * std::min(straightness.gnss_sigma_rad, attitude_rad),
                  is_upright ? ", as ground and walls are" : "");
  }
  check.sentence = text;
  return check;
}

}  // namespace

std::vector<CrossCheck> CheckGnss(const GlobalProblem& problem,
                                  const std::vector<Eigen::Vector3d>& biases_m,
                                  const Georeference& georeference,
                                  const ImageManifest& manifest,
                                  std::span<const Eigen::Vector3d> points_about) {
  std::vector<CrossCheck> checks = georeference.checks;
  if (!georeference.enu_from_world || problem.bundle.position_priors.empty()) return checks;
  const GnssVariance variance = EstimateGnssVariance(problem, biases_m, manifest);
  checks.push_back(CheckCorrelation(problem, variance));
  if (const auto tilt = CheckMountTilt(problem, variance, points_about)) checks.push_back(*tilt);
  return checks;
}

void WidenByDriveErrors(const Georeference& georeference,
                        const ImageManifest& manifest,
                        Reconstruction& model) {
  if (georeference.drive_errors.empty()) return;
  std::vector<Eigen::Vector3d> centres;
  for (const auto& [id, image] : model.images) centres.push_back(image.cam_from_world.Centre());
  const std::vector<Eigen::Matrix3d> covariances =
      CovariancesOfErrors(georeference.drive_errors, GnssDrivesOf(model, manifest), centres);
  size_t i = 0;
  for (auto& [id, image] : model.images) {
    if (image.uncertainty) image.uncertainty->position_covariance += covariances[i];
    ++i;
  }
}

}  // namespace orbweave
