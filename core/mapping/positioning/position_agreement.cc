// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/position_agreement.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/quantile.h"
#include "core/estimators/estimate_similarity.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kFewestPositions = 10.0;
constexpr double kMinExtentSigmas = 3.0;
constexpr double kMaxSigmas = 3.0;
constexpr int kReweightings = 10;

struct Positions {
  std::vector<Vector3d> centres{};
  std::vector<Vector3d> positions{};
  std::vector<double> sigma_m{};
};

Positions PositionsOf(const MappingState& state) {
  Positions found;
  for (const ImageSlot image : state.Registered()) {
    const PosePrior& prior = state.Problem().images[image].prior;
    if (!prior.position_in_enu) continue;
    found.centres.push_back(state.Centre(image));
    found.positions.push_back(*prior.position_in_enu);
    found.sigma_m.push_back(prior.horizontal_sigma_m);
  }
  return found;
}

double ErrorSigmas(const Positions& all, size_t i, const Sim3& enu_from_world) {
  return (enu_from_world * all.centres[i] - all.positions[i]).head<2>().norm() / all.sigma_m[i];
}

}  // namespace

bool DoPositionsSpread(const ClusterProblem& problem,
                       std::span<const ImageSlot> images,
                       double scatter) {
  Vector3d mean = Vector3d::Zero();
  double count = 0.0;
  const auto for_each = [&](const auto& visit) {
    for (const ImageSlot image : images) {
      const PosePrior& prior = problem.images[image].prior;
      if (prior.position_in_enu) visit(*prior.position_in_enu, prior.horizontal_sigma_m);
    }
  };
  for_each([&](const Vector3d& position, double) {
    mean += position;
    count += 1.0;
  });
  if (count < kFewestPositions) return false;
  mean /= count;
  double sum = 0.0;
  for_each([&](const Vector3d& position, double sigma_m) {
    sum += (position - mean).head<2>().squaredNorm() / (sigma_m * sigma_m);
  });
  return std::sqrt(sum / count) >= kMinExtentSigmas * scatter;
}

double ShareOnPositions(const ClusterProblem& problem,
                        std::span<const ImageSlot> images,
                        double scatter,
                        const std::function<Vector3d(ImageSlot)>& centre_of) {
  double all = 0.0;
  double agreeing = 0.0;
  for (const ImageSlot image : images) {
    const PosePrior& prior = problem.images[image].prior;
    if (!prior.position_in_enu) continue;
    const double error_m = (centre_of(image) - *prior.position_in_enu).head<2>().norm();
    agreeing += error_m <= kMaxSigmas * scatter * prior.horizontal_sigma_m ? 1.0 : 0.0;
    all += 1.0;
  }
  return agreeing / all;
}

double ScatterAbout(const ClusterProblem& problem,
                    std::span<const ImageSlot> images,
                    const std::function<Vector3d(ImageSlot)>& centre_of) {
  std::vector<double> errors;
  for (const ImageSlot image : images) {
    const PosePrior& prior = problem.images[image].prior;
    if (!prior.position_in_enu) continue;
    const Vector3d error = centre_of(image) - *prior.position_in_enu;
    errors.push_back(error.head<2>().norm() / prior.horizontal_sigma_m);
  }
  return ScatterOfPositions(errors);
}

std::optional<double> AgreementWithPositions(const MappingState& state) {
  const Positions all = PositionsOf(state);
  if (!DoPositionsSpread(state.Problem(), state.Registered(), 1.0)) return std::nullopt;
  const CauchyLoss loss(1.0);
  std::vector<double> weights(all.positions.size(), 1.0);
  std::vector<double> errors(all.positions.size(), 0.0);
  std::optional<Sim3> enu_from_world;
  for (int round = 0; round <= kReweightings; ++round) {
    enu_from_world = FitSimilarity(all.centres, all.positions, weights);
    if (!enu_from_world) return std::nullopt;
    for (size_t i = 0; i < errors.size(); ++i) {
      errors[i] = ErrorSigmas(all, i, *enu_from_world);
      weights[i] = loss.Weight(errors[i] * errors[i]) / (all.sigma_m[i] * all.sigma_m[i]);
    }
  }
  const auto centre_of = [&](ImageSlot image) -> Vector3d {
    return *enu_from_world * state.Centre(image);
  };
  return ShareOnPositions(
      state.Problem(), state.Registered(), ScatterOfPositions(errors), centre_of);
}

double ScatterOfPositions(const std::vector<double>& errors) {
  constexpr double kShare = 0.25;
  constexpr double kQuantileOfRayleigh = 0.7585;  // of the length of two normal components
  return std::max(1.0, std::min(kMaxScatter, Quantile(errors, kShare) / kQuantileOfRayleigh));
}

}  // namespace orbweave
