// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/rotation.h"

#include <cmath>

namespace orbweave {
namespace {

// Of vectors that are opposite but for rounding.
constexpr double kOppositeCosine = -1.0 + 1e-12;

}  // namespace

Eigen::Matrix3d SkewSymmetric(const Eigen::Vector3d& v) {
  Eigen::Matrix3d skew;
  skew << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return skew;
}

Eigen::Quaterniond RotationFromVector(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  const double half = 0.5 * angle;
  // sin(a/2)/a by its series where the quotient loses digits.
  const double factor = angle < 1e-6 ? 0.5 - angle * angle / 48.0 : std::sin(half) / angle;
  Eigen::Quaterniond q(std::cos(half), factor * w.x(), factor * w.y(), factor * w.z());
  return q.normalized();
}

Eigen::Vector3d VectorFromRotation(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const double sin_half = q.vec().norm();
  const double cos_half = sign * q.w();
  const double factor = sin_half < 1e-9 ? 2.0 : 2.0 * std::atan2(sin_half, cos_half) / sin_half;
  return sign * factor * q.vec();
}

double RotationAngle(const Eigen::Quaterniond& q) {
  return 2.0 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

Eigen::Quaterniond RotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = from.normalized();
  const Eigen::Vector3d b = to.normalized();
  const double cos_angle = b.dot(a);
  Eigen::Quaterniond rotation;
  if (cos_angle < kOppositeCosine) {
    rotation.w() = 0.0;
    rotation.vec() = TangentBasis(a).col(0);
    return rotation;
  }
  const double twice_cos_half = std::sqrt(2.0 * (1.0 + cos_angle));
  rotation.w() = 0.5 * twice_cos_half;
  rotation.vec() = a.cross(b) * (1.0 / twice_cos_half);
  return rotation;
}

Eigen::Matrix<double, 3, 2> TangentBasis(const Eigen::Vector3d& bearing) {
  int axis = 0;
  bearing.cwiseAbs().minCoeff(&axis);
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = bearing.cross(Eigen::Vector3d::Unit(axis)).normalized();
  basis.col(1) = bearing.cross(basis.col(0));
  return basis;
}

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

bool IsWithinAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double max_rad) {
  const double cosine = a.dot(b);
  const double squared_sine = a.cross(b).squaredNorm();
  // An acute angle is no more than its tangent, which up to 0.9 is no more than 1.5 times as much.
  const double in_tangents = max_rad * max_rad * cosine * cosine;
  if (cosine > 0.0 && squared_sine <= in_tangents) return true;
  if (cosine > 0.0 && max_rad < 0.9 && squared_sine > 2.25 * in_tangents) return false;
  return std::atan2(std::sqrt(squared_sine), cosine) <= max_rad;
}

}  // namespace orbweave
