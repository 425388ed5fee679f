// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/bundle/bundle_layout.h"
#include "core/bundle/bundle_problem.h"
#include "core/bundle/bundle_state.h"
#include "core/bundle/gauge.h"

namespace orbweave {

/// By what the variances that observations claim are to be multiplied so that they agree with
/// their residuals: the a-posteriori variance factors of the two kinds of observations.
struct VarianceFactors {
  double bearings = 1.0;
  Eigen::Vector3d positions = Eigen::Vector3d::Ones();  ///< per world axis; x and y are equal
};

/// Of bearings, from the sum of theta^2 / sigma^2 and the redundancy.
[[nodiscard]] double BearingVarianceFactor(double sum_of_squares, double redundancy);

/// Of position priors.
[[nodiscard]] Eigen::Vector3d PositionVarianceFactors(const BundleProblem& problem,
                                                      const BundleState& state);

/// Bearings: sum of theta^2 / sigma^2 over the redundancy (two per observation, less six per pose
/// and three per point, plus what the gauge takes off), as after least squares on filtered
/// observations. Position priors, whose loss is Cauchy's, per axis with the whitened residual r:
///   f = K^2 E[psi^2] / E[psi']^2 * 3n / (3n - p),   K = 1 + p / 3n * Var[psi'] / E[psi']^2,
/// psi = r / (1 + |r|^2 / loss_sigmas^2), p = 7 + 3 biases: the variance of an M-estimate (Huber
/// 1981, 7.6), which outliers hardly change; along z over the n whose heights are known. A
/// factor of nu redundant residuals is then (nu f + 4) / (nu + 2): the mean of the variance where
/// what is stated counts as four residuals (inverse chi-squared). Factors stay above 1e-4 (exact
/// data), and are 1 where nothing is redundant.
[[nodiscard]] VarianceFactors EstimateVarianceFactors(const BundleProblem& problem,
                                                      const BundleLayout& layout,
                                                      const BundleState& state,
                                                      const Gauge& gauge,
                                                      int num_threads);

}  // namespace orbweave
