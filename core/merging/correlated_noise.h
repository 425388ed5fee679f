// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
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

/// Noise is white noise and an Ornstein-Uhlenbeck process, with covariance
///   sigma^2 ((1 - share) [i = j] + share exp(-|place_i - place_j| / length))
/// within a run, none between runs. Their restricted likelihood (Patterson and Thompson 1971: what
/// the fit took from the residuals is allowed for) is taken on a grid of shares and lengths, and
/// what follows for the unknowns of an unweighted fit, (X^T X)^-1 X^T V X (X^T X)^-1, is averaged
/// over it: where little can be told, as from a way no longer than errors hang together, all that
/// may be is in the answer. `information`: what is known of each unknown besides (1 / sigma^2 in
/// units of the residuals' variance, p); 0 is allowed. Needs p + 3 measurements, else nothing is
/// said. Linear in the measurements.
[[nodiscard]] CorrelatedNoise EstimateCorrelatedNoise(std::span<const NoiseRun> runs,
                                                      const Eigen::VectorXd& information);

}  // namespace orbweave
