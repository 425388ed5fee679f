// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace orbweave {

/// Measurements one after the other along a way: residuals of a linear model, and what a unit of
/// each of its p unknowns adds to them.
struct NoiseRun {
  std::vector<double> places{};  ///< along the way, ascending; m of them
  Eigen::MatrixXd design{};      ///< m x p
  Eigen::VectorXd residuals{};   ///< m; none of their scale needs to be known
};

/// How errors of neighbours hang together.
struct CorrelatedNoise {
  /// By what the variance of the unknowns of a fit that takes all measurements as independent is to
  /// be multiplied, on average over what the model predicts: 1 where they are independent.
  double inflation = 1.0;
  /// The same of each unknown by itself (p).
  Eigen::VectorXd inflations{};
  double share = 0.0;   ///< of the variance that neighbours have in common
  double length = 0.0;  ///< over which that fades to 1/e
};

/// Measurements of one kind: their runs are of one model, and have one scale.
struct NoiseAxis {
  std::vector<NoiseRun> runs{};
  /// What is known of each unknown besides: 1 / sigma^2 in units of the residuals' variance, p; 0
  /// is allowed.
  Eigen::VectorXd information{};

  /// Measurements of all runs.
  [[nodiscard]] Eigen::Index Count() const;
};

/// Noise is white noise and an Ornstein-Uhlenbeck process, with covariance
///   sigma^2 ((1 - share) [i = j] + share exp(-|place_i - place_j| / length))
/// within a run, none between runs. What makes errors alike (satellites, houses) does so in all
/// directions, so that share and length may be told by all axes together: of what these make of an
/// axis and what it says by itself, the answer is that which claims less. Their restricted
/// likelihood (Patterson and Thompson 1971: what the fit took from the residuals is allowed for) is
/// taken on a grid of shares and lengths, and what follows for the unknowns of an unweighted fit,
/// (X^T X)^-1 X^T V X (X^T X)^-1, is averaged over it: where little can be told, as from a way no
/// longer than errors hang together, all that may be is in the answer. An axis needs p + 3
/// measurements that are not exact, else it says nothing and nothing is said of it. As many results
/// as axes. Linear in the measurements.
[[nodiscard]] std::vector<CorrelatedNoise> EstimateCorrelatedNoise(
    const std::vector<NoiseAxis>& axes);

}  // namespace orbweave
