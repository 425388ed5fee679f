// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/variance_factors.h"

#include <algorithm>

#include "core/bundle/prior_terms.h"
#include "core/bundle/trial_step.h"

namespace orbweave {
namespace {

constexpr double kMinFactor = 1e-4;
// What is stated counts as so many residuals more: of a few, chance leaves next to nothing.
constexpr double kStatedCounts = 4.0;
// Mean psi' below which positions contradict each other so much that the formula loses its meaning.
constexpr double kMinSlope = 0.05;

// Degrees of freedom of the world that bearings alone leave open and that something else holds.
double GaugeFreedoms(const BundleProblem& problem, const Gauge& gauge) {
  if (!problem.position_priors.empty()) return 7.0;
  return gauge.farthest ? 1.0 : 0.0;  // the anchor is no variable
}

double Redundancy(const BundleProblem& problem, const BundleLayout& layout, const Gauge& gauge) {
  double redundancy = GaugeFreedoms(problem, gauge);
  for (const uint32_t block : layout.pose_block) {
    if (block != kHeld) redundancy -= 6.0;
  }
  for (const PackedPoint& point : layout.points) {
    const double equations = 2.0 * (point.end - point.first);
    redundancy += equations - (point.is_fixed ? 0.0 : std::min(equations, 3.0));
  }
  return redundancy;
}

}  // namespace

Eigen::Vector3d PositionVarianceFactors(const BundleProblem& problem, const BundleState& state) {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();  // of psi
  Eigen::Vector3d slopes = Eigen::Vector3d::Zero();   // psi'
  Eigen::Vector3d squared_slopes = Eigen::Vector3d::Zero();
  Eigen::Vector3d counts = Eigen::Vector3d::Zero();
  for (const PositionPrior& prior : problem.position_priors) {
    const Eigen::Vector3d r2 = WhitenedResidual(prior, state).cwiseAbs2();
    const double scale2 = prior.loss_sigmas * prior.loss_sigmas;
    const double weight = 1.0 / (1.0 + r2.sum() / scale2);
    const Eigen::Vector3d slope =
        Eigen::Vector3d::Constant(weight) - 2.0 / scale2 * weight * weight * r2;
    const Eigen::Vector3d counted(1.0, 1.0, prior.is_height_known ? 1.0 : 0.0);
    squares += weight * weight * counted.cwiseProduct(r2);
    slopes += counted.cwiseProduct(slope);
    squared_slopes += counted.cwiseProduct(slope.cwiseAbs2());
    counts += counted;
  }
  const auto n = static_cast<double>(problem.position_priors.size());
  const double unknowns = 7.0 + 3.0 * static_cast<double>(state.biases.size());
  const double redundancy = 3.0 * n - unknowns;
  if (redundancy < 1.0) return Eigen::Vector3d::Ones();
  for (Eigen::Vector3d* sum : {&squares, &slopes, &squared_slopes}) {
    sum->head<2>().setConstant(0.5 * ((*sum)[0] + (*sum)[1]));
    *sum = sum->cwiseQuotient(counts.cwiseMax(1.0));
  }
  const Eigen::Vector3d squared_mean = slopes.cwiseMax(kMinSlope).cwiseAbs2();
  const Eigen::Vector3d spread = squared_slopes.cwiseQuotient(squared_mean).array() - 1.0;
  const Eigen::Vector3d K = Eigen::Vector3d::Ones() + unknowns / (3.0 * n) * spread.cwiseMax(0.0);
  Eigen::Vector3d factors =
      3.0 * n / redundancy * K.cwiseAbs2().cwiseProduct(squares.cwiseQuotient(squared_mean));
  const auto num_biases = static_cast<double>(state.biases.size());
  const Eigen::Vector3d told(2.0 * n - 4.0 - 2.0 * num_biases,
                             2.0 * n - 4.0 - 2.0 * num_biases,
                             counts.z() - 3.0 - num_biases);
  for (int axis = 0; axis < 3; ++axis) {
    const double nu = std::max(told[axis], 0.0);
    factors[axis] = (nu * factors[axis] + kStatedCounts) / (nu + kStatedCounts - 2.0);
  }
  if (counts.z() == 0.0) factors.z() = 1.0;
  return factors.cwiseMax(kMinFactor);
}

double BearingVarianceFactor(double sum_of_squares, double redundancy) {
  return redundancy < 1.0 ? 1.0 : std::max(sum_of_squares / redundancy, kMinFactor);
}

VarianceFactors EstimateVarianceFactors(const BundleProblem& problem,
                                        const BundleLayout& layout,
                                        const BundleState& state,
                                        const Gauge& gauge,
                                        int num_threads) {
  VarianceFactors factors;
  const RobustLoss least_squares(BundleLoss::kLeastSquares, 1.0);
  const double sum = 2.0 * EvaluatePointCosts(layout, state, least_squares, num_threads).total;
  factors.bearings = BearingVarianceFactor(sum, Redundancy(problem, layout, gauge));
  factors.positions = PositionVarianceFactors(problem, state);
  return factors;
}

}  // namespace orbweave
