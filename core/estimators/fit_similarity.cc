// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "core/base/status.h"
#include "core/estimators/estimate_similarity.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kCollinear = 1e-10;  // squared ratio of width to length

/// Weighted means and second moments of the point pairs.
struct Moments {
  double weight = 0.0;
  Vector3d mean_a = Vector3d::Zero();
  Vector3d mean_b = Vector3d::Zero();
  double variance_a = 0.0;                 // sum w |a - mean_a|^2
  Matrix3d covariance = Matrix3d::Zero();  // sum w (b - mean_b) (a - mean_a)^T
};

Moments MomentsOf(std::span<const Vector3d> a,
                  std::span<const Vector3d> b,
                  std::span<const double> weights) {
  const auto weight = [&](size_t i) { return weights.empty() ? 1.0 : weights[i]; };
  Moments m;
  for (size_t i = 0; i < a.size(); ++i) {
    m.weight += weight(i);
    m.mean_a += weight(i) * a[i];
    m.mean_b += weight(i) * b[i];
  }
  m.mean_a /= m.weight;
  m.mean_b /= m.weight;
  for (size_t i = 0; i < a.size(); ++i) {
    const Vector3d from_mean = a[i] - m.mean_a;
    m.variance_a += weight(i) * from_mean.squaredNorm();
    m.covariance += weight(i) * (b[i] - m.mean_b) * from_mean.transpose();
  }
  return m;
}

}  // namespace

std::optional<Sim3> FitSimilarity(std::span<const Vector3d> points_in_a,
                                  std::span<const Vector3d> points_in_b,
                                  std::span<const double> weights) {
  ORBWEAVE_CHECK(points_in_a.size() == points_in_b.size());
  ORBWEAVE_CHECK(weights.empty() || weights.size() == points_in_a.size());
  if (points_in_a.size() < 3) return std::nullopt;
  const Moments m = MomentsOf(points_in_a, points_in_b, weights);
  const Eigen::JacobiSVD<Matrix3d> svd(m.covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vector3d& d = svd.singularValues();
  if (!(d[1] > kCollinear * d[0])) return std::nullopt;
  // Umeyama (40)-(43): the smallest axis is reversed where U V^T would be a reflection.
  const bool reflects = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0;
  const Vector3d S(1.0, 1.0, reflects ? -1.0 : 1.0);
  const Matrix3d R = svd.matrixU() * S.asDiagonal() * svd.matrixV().transpose();
  const double scale = d.dot(S) / m.variance_a;
  if (!(scale > 0.0) || !std::isfinite(scale)) return std::nullopt;
  return Sim3{scale, Eigen::Quaterniond(R).normalized(), m.mean_b - scale * (R * m.mean_a)};
}

}  // namespace orbweave
