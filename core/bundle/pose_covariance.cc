// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/pose_covariance.h"

#include <utility>

#include "core/bundle/block_cholesky.h"
#include "core/bundle/prior_terms.h"

namespace orbweave {
namespace {

// Just above rounding: keeps the depth of a point seen once free, and holds no world.
constexpr double kPointDamping = 1e-14;
// The sigma of a free direction becomes a million times that of a well observed one.
constexpr double kPoseDamping = 1e-12;

// Poses that see nothing are no variables.
Gauge GaugeOfObserved(const BundleProblem& problem, const std::vector<uint8_t>& observes) {
  Gauge gauge = ChooseGauge(problem);
  for (size_t i = 0; i < observes.size(); ++i) {
    if (!observes[i]) gauge.pose_is_held[i] = 1;
  }
  return gauge;
}

std::vector<uint8_t> PosesWithObservations(const BundleProblem& problem) {
  std::vector<uint8_t> observes(problem.cams_from_world.size(), 0);
  for (const BundleObservation& seen : problem.observations) observes[seen.pose] = 1;
  return observes;
}

void Scale(double factor, ReducedSystem& system) {
  for (Block6& block : system.S.values) block *= factor;
  for (Eigen::Vector2d& trace : system.trace) trace *= factor;
}

// The problem's priors with variances times their factor. Positions are moved to the estimate:
// where the residual is zero, Cauchy's loss weighs as least squares do.
BundleProblem PriorsByFactor(const LinearisedBundle& bundle, const VarianceFactors& factors) {
  BundleProblem priors;
  priors.bias_sigma_m = bundle.problem.bias_sigma_m;
  priors.direction_priors = bundle.problem.direction_priors;
  for (PositionPrior prior : bundle.problem.position_priors) {
    if (bundle.layout.pose_block[prior.pose] == kHeld) continue;
    prior.sigma_m = prior.sigma_m.cwiseProduct(factors.positions.cwiseSqrt());
    prior.position_in_world = bundle.state.poses[prior.pose].centre;
    if (prior.bias_group) prior.position_in_world += bundle.state.biases[*prior.bias_group];
    priors.position_priors.push_back(prior);
  }
  return priors;
}

std::optional<std::vector<Block6>> InvertDiagonal(ReducedSystem system) {
  BlockCholesky cholesky(system.S);
  if (!cholesky.Factorize(system.S)) {
    DampPoses(kPoseDamping, system);
    if (!cholesky.Factorize(system.S)) return std::nullopt;
  }
  system = {};  // the inverse is larger
  return cholesky.InverseDiagonal();
}

// The spring left a variance of 1 / stiffness to the held distance, the world's scale with it;
// stiffer than any spring is to take it off again. Moves a centre by its distance to the anchor
// per unit of the held distance.
void RemoveSpring(const LinearisedBundle& bundle, double stiffness, PoseCovariances& covariances) {
  if (!bundle.gauge.farthest) return;
  const Eigen::Vector3d anchor = bundle.state.poses[*bundle.gauge.anchor].centre;
  const double distance = (bundle.state.poses[*bundle.gauge.farthest].centre - anchor).norm();
  for (size_t i = 0; i < covariances.poses.size(); ++i) {
    if (bundle.layout.pose_block[i] == kHeld) continue;
    const Eigen::Vector3d shift = (bundle.state.poses[i].centre - anchor) / distance;
    covariances.poses[i]->bottomRightCorner<3, 3>() -= shift * shift.transpose() / stiffness;
  }
}

}  // namespace

PoseCovariances CovariancesOfSystem(const LinearisedBundle& bundle,
                                    const VarianceFactors& factors,
                                    ReducedSystem bearings) {
  const size_t num_poses = bundle.layout.pose_block.size();
  PoseCovariances result{.poses = std::vector<std::optional<Block6>>(num_poses),
                         .anchor = bundle.gauge.anchor,
                         .farthest = bundle.gauge.farthest,
                         .factors = factors};
  Scale(1.0 / factors.bearings, bearings);
  AddPriorTerms(PriorsByFactor(bundle, factors), bundle.layout, bundle.state, bearings);
  const double stiffness = AddDistanceSpring(bundle.gauge, bundle.layout, bundle.state, bearings);
  const std::optional<std::vector<Block6>> blocks = InvertDiagonal(std::move(bearings));
  if (!blocks) {
    result.reason = "the normal equations of the poses are not positive definite";
    return result;
  }
  for (size_t i = 0; i < num_poses; ++i) {
    const uint32_t block = bundle.layout.pose_block[i];
    result.poses[i] = block == kHeld ? Block6(Block6::Zero()) : (*blocks)[block];
  }
  RemoveSpring(bundle, stiffness, result);
  return result;
}

PoseCovariances EstimatePoseCovariances(const BundleProblem& problem,
                                        const std::vector<Eigen::Vector3d>& biases_m,
                                        int num_threads) {
  const std::vector<uint8_t> observes = PosesWithObservations(problem);
  const Gauge gauge = GaugeOfObserved(problem, observes);
  const BundleLayout layout = MakeBundleLayout(problem, gauge);
  BundleState state = InitialState(problem);
  state.biases = biases_m;
  ReducedSystem bearings = MakeReducedSystem(layout);
  BearingReducer(layout, num_threads)
      .AddBearings(state, RobustLoss(BundleLoss::kLeastSquares, 1.0), kPointDamping, bearings);
  PoseCovariances result =
      CovariancesOfSystem({problem, layout, state, gauge},
                          EstimateVarianceFactors(problem, layout, state, gauge, num_threads),
                          std::move(bearings));
  for (size_t i = 0; i < observes.size(); ++i) {
    if (!observes[i]) result.poses[i].reset();
  }
  return result;
}

}  // namespace orbweave
