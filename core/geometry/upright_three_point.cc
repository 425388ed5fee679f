// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/upright_three_point.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "core/geometry/real_roots.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// The half-angle tangent is infinite at pi, and upright cameras do look the opposite way: image a
/// is first turned by an angle at which nobody mounts a camera.
constexpr double kTurnRad = 1.0;
constexpr double kParallelSin = 1e-9;

/// Vector of quadratics in s, lowest power first: n(s) = (1 + s^2) R(s) p_a x p_b.
using Normal = std::array<Vector3d, 3>;

Normal MakeNormal(const Vector3d& a, const Vector3d& b) {
  return {Vector3d(a.x(), a.y(), a.z()).cross(b),
          Vector3d(2.0 * a.z(), 0.0, -2.0 * a.x()).cross(b),
          Vector3d(-a.x(), a.y(), -a.z()).cross(b)};
}

Vector3d At(const Normal& n, double s) { return n[0] + s * (n[1] + s * n[2]); }

/// det(n0, n1, n2) / (1 + s^2), a quartic.
std::array<double, 5> Quartic(const std::array<Normal, 3>& n) {
  std::array<double, 7> det{};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      const Vector3d cross = n[0][i].cross(n[1][j]);
      for (size_t k = 0; k < 3; ++k) det[i + j + k] += cross.dot(n[2][k]);
    }
  }
  std::array<double, 5> quotient{};
  for (size_t k = 5; k-- > 0;) quotient[k] = det[k + 2] - (k + 2 < 5 ? quotient[k + 2] : 0.0);
  return quotient;
}

}  // namespace

absl::InlinedVector<Rigid3, 4> SolveUprightThreePoint(std::span<const Vector3d, 3> bearings_a,
                                                      std::span<const Vector3d, 3> bearings_b) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(kTurnRad, Vector3d::UnitY()));
  std::array<Normal, 3> normals;
  for (size_t i = 0; i < 3; ++i) normals[i] = MakeNormal(turn * bearings_a[i], bearings_b[i]);

  absl::InlinedVector<Rigid3, 4> poses;
  for (const double s : RealRoots(Quartic(normals))) {
    const std::array<Vector3d, 3> n = {At(normals[0], s), At(normals[1], s), At(normals[2], s)};
    Vector3d T = n[0].cross(n[1]);
    for (const Vector3d& other : {n[1].cross(n[2]).eval(), n[2].cross(n[0]).eval()}) {
      if (other.squaredNorm() > T.squaredNorm()) T = other;
    }
    const double length = T.norm();
    if (!(length > kParallelSin * (1.0 + s * s) * (1.0 + s * s))) continue;
    const Eigen::Quaterniond R(Eigen::AngleAxisd(2.0 * std::atan(s), Vector3d::UnitY()));
    poses.push_back({(R * turn).normalized(), T / length});
  }
  return poses;
}

}  // namespace orbweave
