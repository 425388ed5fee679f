// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/prior_terms.h"

#include "core/bundle/bearing_term.h"
#include "core/geometry/rotation.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

// A direction is a point at unit distance from a camera in the origin.
BearingTerm LineariseDirection(const DirectionPrior& prior, const BundleState& state) {
  return LineariseBearing(Eigen::Vector3d::Zero(),
                          prior.direction_in_world,
                          state.poses[prior.pose].world_from_cam * prior.direction_in_cam);
}

// Adds a diagonal weight on the centre and the gradient there.
void AddToBlock(uint32_t block,
                const Eigen::Vector3d& weight,
                const Eigen::Vector3d& gradient,
                ReducedSystem& system) {
  if (block == kHeld) return;
  system.S.Diagonal(block).diagonal().tail<3>() += weight;
  system.trace[block][1] += weight.sum();
  system.gradient[block].tail<3>() += gradient;
  system.rhs[block].tail<3>() -= gradient;
}

void AddPositionTerms(const BundleProblem& problem,
                      const BundleLayout& layout,
                      const BundleState& state,
                      ReducedSystem& system) {
  for (const PositionPrior& prior : problem.position_priors) {
    const Eigen::Vector3d residual = WhitenedResidual(prior, state);
    const double loss_weight = CauchyLoss(prior.loss_sigmas).Weight(residual.squaredNorm());
    const Eigen::Vector3d weight = loss_weight * prior.sigma_m.cwiseAbs2().cwiseInverse();
    const Eigen::Vector3d gradient = loss_weight * residual.cwiseQuotient(prior.sigma_m);
    const uint32_t pose = layout.pose_block[prior.pose];
    const uint32_t bias = prior.bias_group ? layout.bias_block[*prior.bias_group] : kHeld;
    AddToBlock(pose, weight, gradient, system);
    AddToBlock(bias, weight, gradient, system);
    if (pose == kHeld || bias == kHeld) continue;
    Block6& between = system.S.values[system.S.Find({.column = bias, .row = pose})];
    between.diagonal().tail<3>() += weight;
  }
}

void AddBiasTerms(const BundleProblem& problem,
                  const BundleLayout& layout,
                  const BundleState& state,
                  ReducedSystem& system) {
  for (size_t g = 0; g < state.biases.size(); ++g) {
    if (layout.bias_block[g] == kHeld) continue;
    const double weight = 1.0 / (problem.bias_sigma_m[g] * problem.bias_sigma_m[g]);
    AddToBlock(
        layout.bias_block[g], Eigen::Vector3d::Constant(weight), weight * state.biases[g], system);
  }
}

void AddDirectionTerms(const BundleProblem& problem,
                       const BundleLayout& layout,
                       const BundleState& state,
                       ReducedSystem& system) {
  for (const DirectionPrior& prior : problem.direction_priors) {
    const uint32_t block = layout.pose_block[prior.pose];
    if (block == kHeld) continue;
    const BearingTerm term = LineariseDirection(prior, state);
    const double weight = 1.0 / (prior.sigma_rad * prior.sigma_rad);
    const Eigen::Matrix3d D = SkewSymmetric(prior.direction_in_world);
    const Eigen::Matrix3d hessian = D * PointHessian(term, weight) * D.transpose();
    const Eigen::Vector3d gradient = D * PointGradient(term, weight);
    system.S.Diagonal(block).topLeftCorner<3, 3>() += hessian;
    system.trace[block][0] += hessian.trace();
    system.gradient[block].head<3>() += gradient;
    system.rhs[block].head<3>() -= gradient;
  }
}

}  // namespace

Eigen::Vector3d WhitenedResidual(const PositionPrior& prior, const BundleState& state) {
  Eigen::Vector3d difference = state.poses[prior.pose].centre - prior.position_in_world;
  if (prior.bias_group) difference += state.biases[*prior.bias_group];
  return difference.cwiseQuotient(prior.sigma_m);
}

double PriorCost(const BundleProblem& problem, const BundleState& state) {
  double cost = 0.0;
  for (const PositionPrior& prior : problem.position_priors) {
    cost += 0.5 * CauchyLoss(prior.loss_sigmas).Cost(WhitenedResidual(prior, state).squaredNorm());
  }
  for (size_t g = 0; g < state.biases.size(); ++g) {
    const double sigma = problem.bias_sigma_m[g];
    if (sigma > 0.0) cost += 0.5 * state.biases[g].squaredNorm() / (sigma * sigma);
  }
  for (const DirectionPrior& prior : problem.direction_priors) {
    const BearingTerm term = LineariseDirection(prior, state);
    cost += 0.5 * term.squared_angle / (prior.sigma_rad * prior.sigma_rad);
  }
  return cost;
}

void AddPriorTerms(const BundleProblem& problem,
                   const BundleLayout& layout,
                   const BundleState& state,
                   ReducedSystem& system) {
  AddPositionTerms(problem, layout, state, system);
  AddBiasTerms(problem, layout, state, system);
  AddDirectionTerms(problem, layout, state, system);
}

double AddDistanceSpring(const Gauge& gauge,
                         const BundleLayout& layout,
                         const BundleState& state,
                         ReducedSystem& system) {
  if (!gauge.farthest) return 0.0;
  const uint32_t block = layout.pose_block[*gauge.farthest];
  const Eigen::Vector3d axis =
      (state.poses[*gauge.farthest].centre - state.poses[*gauge.anchor].centre).normalized();
  const double stiffness = system.trace[block][1] / 3.0;
  system.S.Diagonal(block).bottomRightCorner<3, 3>() += stiffness * axis * axis.transpose();
  return stiffness;
}

}  // namespace orbweave
