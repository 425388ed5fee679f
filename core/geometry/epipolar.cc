// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/epipolar.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbweave {

using Eigen::Vector3d;
using std::numbers::pi;

double EpipolarAngle(const Eigen::Matrix3d& E, const Vector3d& p_a, const Vector3d& p_b) {
  const Vector3d normal = E * p_a;
  const double length = normal.norm();
  if (!(length > 0.0)) return pi / 2.0;
  return std::asin(std::min(1.0, std::abs(p_b.dot(normal)) / length));
}

double SymmetricEpipolarAngle(const Rigid3& b_from_a, const Vector3d& p_a, const Vector3d& p_b) {
  const Vector3d& T = b_from_a.translation;
  const Vector3d q = b_from_a.rotation * p_a;
  const double f = p_b.dot(T.cross(q));  // p_b^T E p_a
  const double along_a = T.dot(q);       // |E p_a|^2 = 1 - along_a^2, |E^T p_b|^2 = 1 - along_b^2
  const double along_b = T.dot(p_b);
  const double squared = 1.0 - 0.5 * (along_a * along_a + along_b * along_b);
  if (!(squared > 0.0)) return pi / 2.0;
  return std::asin(std::min(1.0, std::abs(f) / std::sqrt(squared)));
}

bool IsInFrontOfBoth(const Rigid3& b_from_a, const Vector3d& p_a, const Vector3d& p_b) {
  // lambda_b p_b = lambda_a q + T in least squares, times 1 - (q.p_b)^2 >= 0.
  const Vector3d q = b_from_a.rotation * p_a;
  const double c = q.dot(p_b);
  const double along_a = b_from_a.translation.dot(q);
  const double along_b = b_from_a.translation.dot(p_b);
  return c * along_b - along_a > 0.0 && along_b - c * along_a > 0.0;
}

}  // namespace orbweave
