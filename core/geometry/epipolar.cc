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
  return PoseOfRays(b_from_a)(p_a, p_b).SymmetricEpipolarAngle();
}

bool IsInFrontOfBoth(const Rigid3& b_from_a, const Vector3d& p_a, const Vector3d& p_b) {
  return PoseOfRays(b_from_a)(p_a, p_b).IsInFrontOfBoth();
}

double RayPair::SquaredNormal() const {
  // |E p_a|^2 = 1 - along_a^2, |E^T p_b|^2 = 1 - along_b^2
  return 1.0 - 0.5 * (along_a * along_a + along_b * along_b);
}

double RayPair::SymmetricEpipolarAngle() const {
  const double squared = SquaredNormal();
  if (!(squared > 0.0)) return pi / 2.0;
  return std::asin(std::min(1.0, std::abs(lift) / std::sqrt(squared)));
}

bool RayPair::IsWithin(double max_rad) const {
  const double squared = SquaredNormal();
  // e - e^3 / 6 <= sin e <= e, and so e^2 (1 - e^2 / 3) <= sin^2 e.
  const double most = max_rad * max_rad * squared;
  if (lift * lift <= most * (1.0 - max_rad * max_rad / 3.0) && squared > 0.0) return true;
  if (lift * lift > most && squared > 0.0) return false;
  return SymmetricEpipolarAngle() <= max_rad;
}

bool RayPair::IsInFrontOfBoth() const {
  // lambda_b p_b = lambda_a q + T in least squares, times 1 - (q.p_b)^2 >= 0.
  return cosine * along_b - along_a > 0.0 && along_b - cosine * along_a > 0.0;
}

}  // namespace orbweave
