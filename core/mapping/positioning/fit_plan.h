// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "core/scene/image_manifest.h"

namespace orbweave {

/// A camera of an upright model and its position, seen from above.
struct PlanStation {
  std::complex<double> centre{};
  std::complex<double> position{};
  double sigma_m = 1.0;
  double weight = 1.0;
};

/// A centre in a frame whose third axis is up, and its position, which must be there.
[[nodiscard]] inline PlanStation SeenFromAbove(const Eigen::Vector3d& centre,
                                               const PosePrior& prior) {
  return {.centre = {centre.x(), centre.y()},
          .position = {prior.position_in_enu->x(), prior.position_in_enu->y()},
          .sigma_m = prior.horizontal_sigma_m};
}

/// By so much more than independent errors would leave a fit is off, as receivers share errors over
/// about ten places: 148 positions of a block were worth twelve.
inline constexpr double kErrorsShared = 3.0;

/// The similarity position = turn * centre + shift, with |turn| the scale: four unknowns, so that a
/// straight street determines them too.
struct PlanFit {
  std::complex<double> turn{};  ///< zero where centres coincide
  std::complex<double> shift{};
  double extent_sigmas = 0.0;  ///< rms distance of the centres from their mean

  /// Standard deviation of the logarithm of its scale, as told by `count` stations with independent
  /// errors as stated.
  [[nodiscard]] double SigmaOfScale(size_t count) const {
    return 1.0 / (extent_sigmas * std::sqrt(static_cast<double>(count)));
  }
  [[nodiscard]] double ErrorSigmas(const PlanStation& station) const {
    return std::abs(turn * station.centre + shift - station.position) / station.sigma_m;
  }
};

/// By reweighted least squares (Cauchy); weights of stations are renewed.
[[nodiscard]] PlanFit FitPlanRobustly(std::vector<PlanStation>& stations);

}  // namespace orbweave
