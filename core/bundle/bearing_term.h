// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/geometry/rotation.h"

namespace orbweave {

/// One observation's part of the normal equations, without a tangent basis. With d = X - C, u =
/// d/|d|, b the observed bearing turned into the world, c = b.u and q = c u - b (so |q| = sin
/// theta):
///   gradient of theta^2/2 by u:     f q,                            f = theta / sin theta
///   Gauss-Newton Hessian by u:      f^2 (I - u u^T) + k q q^T,      k = (1 - f^2) / sin^2 theta
/// which are J^T r and J^T J of r = log_b(u), exactly (EvaluateBearingResidual). By X they are
/// divided by |d| and |d|^2, since q and I - u u^T are orthogonal to u. By C they change sign; by
/// the rotation R exp([w]x) they are multiplied from the left by [d]x. Near the antipode f of the
/// Hessian is bounded as in EvaluateBearingResidual; the gradient is exact.
struct BearingTerm {
  Eigen::Vector3d d = Eigen::Vector3d::Zero();
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  Eigen::Vector3d q = Eigen::Vector3d::Zero();
  double inverse_range = 0.0;
  double squared_angle = 0.0;
  double f = 0.0;
  double f2 = 0.0;  ///< of the Hessian
  double k = 0.0;
};

namespace internal {

// Angles beyond 1.8 degrees, and the half sphere behind the bearing.
inline void SetLargeAngle(double sine, double cosine, const Eigen::Vector3d& b, BearingTerm& term) {
  constexpr double kMinSine = 0.1;
  if (sine < 1e-12) {  // the antipode: every direction leads away from it
    term.q = TangentBasis(b).col(0);
    sine = 1.0;
    term.f = std::acos(-1.0);
    term.f2 = term.f * term.f / (kMinSine * kMinSine);
    term.squared_angle = term.f * term.f;
    term.k = 1.0 - term.f2;
    return;
  }
  const double theta = std::atan2(sine, cosine);
  const double f_across = theta / (cosine < 0.0 ? std::max(sine, kMinSine) : sine);
  term.f = theta / sine;
  term.f2 = f_across * f_across;
  term.k = (1.0 - term.f2) / (sine * sine);
  term.squared_angle = theta * theta;
}

// d, u, q and cos theta; false when the point lies in the centre.
inline bool SetDirections(const Eigen::Vector3d& centre,
                          const Eigen::Vector3d& point,
                          const Eigen::Vector3d& b,
                          BearingTerm& term,
                          double& cosine) {
  term.d = point - centre;
  const double squared_range = term.d.squaredNorm();
  if (!(squared_range > 0.0)) return false;
  term.inverse_range = 1.0 / std::sqrt(squared_range);
  term.u = term.d * term.inverse_range;
  cosine = b.dot(term.u);
  term.q = cosine * term.u - b;
  return true;
}

constexpr double kSmallSquaredSine = 1e-3;

// (asin(s)^2 / s^2 - 1) / s^2 as a series in s^2, exact to rounding up to kSmallSquaredSine.
inline double SquareSeries(double s2) {
  return 1.0 / 3.0 +
         s2 * (8.0 / 45.0 + s2 * (4.0 / 35.0 + s2 * (128.0 / 1575.0 + s2 * (128.0 / 2079.0))));
}

// asin(s) / s as a series in s^2.
inline double QuotientSeries(double s2) {
  return 1.0 +
         s2 * (1.0 / 6.0 + s2 * (3.0 / 40.0 +
                                 s2 * (5.0 / 112.0 + s2 * (35.0 / 1152.0 + s2 * (63.0 / 2816.0)))));
}

}  // namespace internal

/// `b`: unit bearing in the world, R^T bearing_in_cam. All zero when the point lies in the centre.
inline BearingTerm LineariseBearing(const Eigen::Vector3d& centre,
                                    const Eigen::Vector3d& point,
                                    const Eigen::Vector3d& b) {
  BearingTerm term;
  double cosine = 0.0;
  if (!internal::SetDirections(centre, point, b, term, cosine)) return term;
  const double s2 = term.q.squaredNorm();
  if (cosine > 0.0 && s2 < internal::kSmallSquaredSine) {
    const double series = internal::SquareSeries(s2);
    term.f = internal::QuotientSeries(s2);
    term.f2 = 1.0 + s2 * series;
    term.k = -series;
    term.squared_angle = s2 * term.f2;
  } else {
    internal::SetLargeAngle(std::sqrt(s2), cosine, b, term);
  }
  return term;
}

/// Squared angle between the ray from centre to point and b, and whether it lies behind b.
struct BearingAngle {
  double squared_angle = 0.0;
  bool behind = false;
};

inline BearingAngle EvaluateBearing(const Eigen::Vector3d& centre,
                                    const Eigen::Vector3d& point,
                                    const Eigen::Vector3d& b) {
  BearingTerm term;
  double cosine = 0.0;
  if (!internal::SetDirections(centre, point, b, term, cosine)) return {};
  const double s2 = term.q.squaredNorm();
  if (cosine > 0.0 && s2 < internal::kSmallSquaredSine) {
    return {s2 * (1.0 + s2 * internal::SquareSeries(s2)), false};
  }
  const double theta = std::atan2(std::sqrt(s2), cosine);
  return {theta * theta, cosine <= 0.0};
}

/// J^T J by the point, times `weight`.
inline Eigen::Matrix3d PointHessian(const BearingTerm& term, double weight) {
  const double w = weight * term.inverse_range * term.inverse_range;
  const double a = w * term.f2;
  const double b = w * term.k;
  Eigen::Matrix3d M;
  for (int j = 0; j < 3; ++j) {
    const double uj = -a * term.u[j];
    const double qj = b * term.q[j];
    for (int i = 0; i < 3; ++i) M(i, j) = term.u[i] * uj + term.q[i] * qj;
    M(j, j) += a;
  }
  return M;
}

/// J^T r by the point, times `weight`.
inline Eigen::Vector3d PointGradient(const BearingTerm& term, double weight) {
  return (weight * term.f * term.inverse_range) * term.q;
}

}  // namespace orbweave
