// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/gnss_variance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/bundle/bundle_state.h"
#include "core/bundle/variance_factors.h"
#include "core/merging/georeference/drive_sequences.h"

namespace orbweave {
namespace {

constexpr double kOutlierSigmas = 3.37;  // 99 % of three normal variables

struct Runs {
  std::vector<MeasuredRun> runs{};  // per drive, in sequence
  double extent_m = 1.0;
};

Runs CollectRuns(const GlobalProblem& problem,
                 const BundleState& state,
                 const Eigen::Vector3d& factors,
                 const ImageManifest& manifest) {
  std::map<ImageId, const PositionPrior*> priors;
  std::map<ImageId, Eigen::Vector3d> centres;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const PositionPrior& prior : problem.bundle.position_priors) {
    priors[problem.image_of_pose[prior.pose]] = &prior;
    centres[problem.image_of_pose[prior.pose]] = state.poses[prior.pose].centre;
    middle += state.poses[prior.pose].centre;
  }
  middle /= static_cast<double>(priors.size());
  Runs result;
  double squares = 0.0;
  for (const DriveSequence& sequence : DriveSequences(centres, manifest)) {
    MeasuredRun run;
    double way_m = 0.0;
    const PositionPrior* before = nullptr;
    for (const ImageId id : sequence.images) {
      const PositionPrior& prior = *priors.at(id);
      const Eigen::Vector3d& centre = centres.at(id);
      if (before != nullptr) way_m += (centre - state.poses[before->pose].centre).norm();
      before = &prior;
      Eigen::Vector3d residual = centre - prior.position_in_world;
      if (prior.bias_group) residual += state.biases[*prior.bias_group];
      residual = residual.cwiseQuotient(prior.sigma_m);
      if (residual.cwiseQuotient(factors.cwiseSqrt()).norm() > kOutlierSigmas) continue;
      run.push_back({.at = centre - middle,
                     .residual = residual,
                     .sigma_m = prior.sigma_m,
                     .way_m = way_m,
                     .is_height_known = prior.is_height_known});
      squares += (centre - middle).squaredNorm();
    }
    if (!run.empty()) result.runs.push_back(std::move(run));
  }
  result.extent_m = std::max(std::sqrt(squares / static_cast<double>(priors.size())), 1e-9);
  for (MeasuredRun& run : result.runs) {
    for (MeasuredFix& measured : run) measured.at /= result.extent_m;
  }
  return result;
}

NoiseRun AxisOf(const MeasuredRun& run, int axis) {
  const auto takes_part = [axis](const MeasuredFix& measured) {
    return axis != 2 || measured.is_height_known;
  };
  const Eigen::Index m = std::ranges::count_if(run, takes_part);
  NoiseRun noise{.design = Eigen::MatrixXd::Zero(m, axis == 2 ? 3 : 4),
                 .residuals = Eigen::VectorXd(m)};
  Eigen::Index i = 0;
  for (const MeasuredFix& measured : run) {
    if (!takes_part(measured)) continue;
    const Eigen::Vector3d& at = measured.at;
    noise.places.push_back(measured.way_m);
    noise.residuals[i] = measured.residual[axis];
    if (axis == 0) noise.design.row(i) << 1.0, 0.0, -at.y(), at.x();  // shift, turn, scale
    if (axis == 1) noise.design.row(i) << 0.0, 1.0, at.x(), at.y();
    if (axis == 2) noise.design.row(i) << 1.0, at.y(), -at.x();  // shift, tilt
    noise.design.row(i++) /= measured.sigma_m[axis];
  }
  return noise;
}

// What gravity knows of the tilt: in units of the residuals' variance.
double GravityInformation(const GlobalProblem& problem, double extent_m) {
  double information = 0.0;
  for (const DirectionPrior& prior : problem.bundle.direction_priors)
    information += 1.0 / (prior.sigma_rad * prior.sigma_rad);
  return information / (extent_m * extent_m);
}

}  // namespace

PositionNoise EstimatePositionNoise(const std::vector<MeasuredRun>& runs, double tilt_information) {
  std::vector<NoiseAxis> axes(2);
  axes[0].information = Eigen::VectorXd::Zero(4);
  axes[1].information = Eigen::Vector3d(0.0, tilt_information, tilt_information);
  for (const MeasuredRun& run : runs) {
    axes[0].runs.push_back(AxisOf(run, 0));
    axes[0].runs.push_back(AxisOf(run, 1));
    axes[1].runs.push_back(AxisOf(run, 2));
  }
  const std::vector<CorrelatedNoise> noise = EstimateCorrelatedNoise(axes);
  return {.horizontal = noise[0], .vertical = noise[1]};
}

GnssVariance EstimateGnssVariance(const GlobalProblem& problem,
                                  const std::vector<Eigen::Vector3d>& biases_m,
                                  const ImageManifest& manifest) {
  GnssVariance variance;
  if (problem.bundle.position_priors.empty()) return variance;
  BundleState state = InitialState(problem.bundle);
  state.biases = biases_m;
  variance.factors = PositionVarianceFactors(problem.bundle, state);
  const Runs runs = CollectRuns(problem, state, variance.factors, manifest);
  if (runs.runs.empty()) return variance;

  const double tilt = variance.factors.z() * GravityInformation(problem, runs.extent_m);
  variance.noise = EstimatePositionNoise(runs.runs, tilt);
  variance.factors.head<2>() *= variance.noise.horizontal.inflation;
  variance.factors.z() *= variance.noise.vertical.inflation;
  return variance;
}

}  // namespace orbweave
