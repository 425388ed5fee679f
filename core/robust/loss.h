// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace orbweave {

/// Cauchy loss rho(s) = c^2 log(1 + s / c^2) of a squared residual s; rho(s) ~ s for small s, and
/// the influence of large residuals falls like 1 / r.
class CauchyLoss {
 public:
  /// `scale` c > 0 in units of the residual.
  explicit CauchyLoss(double scale) : squared_scale_(scale * scale) {}

  [[nodiscard]] double Cost(double squared) const {
    return squared_scale_ * std::log1p(squared / squared_scale_);
  }
  /// rho'(s), the weight of the residual in iteratively reweighted least squares: 1 at s = 0.
  [[nodiscard]] double Weight(double squared) const {
    return squared_scale_ / (squared_scale_ + squared);
  }

 private:
  double squared_scale_;
};

/// Geman and McClure's loss rho(s) = s / (1 + s / c^2) of a squared residual s (Statistical methods
/// for tomographic image reconstruction, 1987): c^2 at most, so that what is far off hardly counts
/// at all.
class GemanMcClureLoss {
 public:
  /// `scale` c > 0 in units of the residual.
  explicit constexpr GemanMcClureLoss(double scale) : squared_scale_(scale * scale) {}

  [[nodiscard]] double Cost(double squared) const {
    return squared / (1.0 + squared / squared_scale_);
  }
  /// rho'(s).
  [[nodiscard]] double Weight(double squared) const {
    const double root = 1.0 + squared / squared_scale_;
    return 1.0 / (root * root);
  }

 private:
  double squared_scale_;
};

}  // namespace orbweave
