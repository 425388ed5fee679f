// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "core/bundle/bearing_term.h"
#include "core/bundle/bundle_options.h"

namespace orbweave {

/// rho(s) of a squared whitened residual s, with scale a; rho(s) ~ s for small s.
///   Cauchy: a^2 log(1 + s / a^2);  Huber: s up to a^2, then 2 a sqrt(s) - a^2.
class RobustLoss {
 public:
  RobustLoss(BundleLoss kind, double scale) : kind_(kind), a2_(scale * scale) {}

  /// The same loss, linearised with or without Bend.
  [[nodiscard]] RobustLoss Bent(bool is_bent) const {
    RobustLoss loss = *this;
    loss.is_bent_ = is_bent;
    return loss;
  }

  /// rho'(s), the weight of iteratively reweighted least squares.
  [[nodiscard]] double Weight(double s) const {
    if (kind_ == BundleLoss::kCauchy) return a2_ / (a2_ + s);
    if (kind_ == BundleLoss::kHuber && s > a2_) return std::sqrt(a2_ / s);
    return 1.0;
  }

  /// 2 rho''(s) / rho'(s): bends the curvature along the residual from rho' to rho' + 2 s rho'';
  /// zero unless bent.
  [[nodiscard]] double Bend(double s) const {
    if (!is_bent_) return 0.0;
    if (kind_ == BundleLoss::kCauchy) return -2.0 / (a2_ + s);
    if (kind_ == BundleLoss::kHuber && s > a2_) return -1.0 / s;
    return 0.0;
  }

  /// Sums rho over residuals; one logarithm for many Cauchy terms, as their product's.
  class Sum {
   public:
    explicit Sum(const RobustLoss& loss) : loss_(loss) {}
    void Add(double s) {
      if (loss_.kind_ == BundleLoss::kCauchy) {
        product_ *= 1.0 + s / loss_.a2_;
        if (product_ > 1e200) Flush();
      } else if (loss_.kind_ == BundleLoss::kHuber && s > loss_.a2_) {
        sum_ += 2.0 * std::sqrt(loss_.a2_ * s) - loss_.a2_;
      } else {
        sum_ += s;
      }
    }
    [[nodiscard]] double Value() {
      Flush();
      return sum_;
    }

   private:
    void Flush() {
      if (product_ != 1.0) sum_ += loss_.a2_ * std::log(product_);
      product_ = 1.0;
    }
    const RobustLoss& loss_;
    double sum_ = 0.0;
    double product_ = 1.0;
  };

 private:
  BundleLoss kind_;
  double a2_;
  bool is_bent_ = false;
};

/// Turns a term of theta^2/2 into one of rho(weight theta^2)/2: returns the factor rho' weight of
/// its gradient and Hessian and bends the Hessian along the residual to rho' + 2 s rho'', as Newton
/// would, but never below kMinBend of rho' so that it stays positive.
[[nodiscard]] inline double ApplyLoss(const RobustLoss& loss, double weight, BearingTerm& term) {
  constexpr double kMinBend = 0.2;
  const double s = weight * term.squared_angle;
  const double bend = loss.Bend(s);
  const double per_squared_sine = term.f * term.f;  // theta^2 / |q|^2
  if (1.0 + bend * s > kMinBend) {
    term.k += bend * weight * per_squared_sine;
  } else {
    term.k += (kMinBend - 1.0) * per_squared_sine / term.squared_angle;
  }
  return weight * loss.Weight(s);
}

}  // namespace orbweave
