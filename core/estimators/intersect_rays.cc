// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/intersect_rays.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kParallelSin = 1e-6;  // 0.2 arc seconds: no depth in double precision
constexpr int kMaxSteps = 8;           // Gauss-Newton; two or three are the rule
constexpr double kStepTolerance = 1e-9;

bool AllParallel(const Rays& rays) {
  return std::all_of(rays.begin(), rays.end(), [&](const Ray& ray) {
    return rays[0].direction.cross(ray.direction).squaredNorm() < kParallelSin * kParallelSin;
  });
}

Vector3d NearestToLines(const Rays& rays) {
  Matrix3d A = Matrix3d::Zero();
  Vector3d b = Vector3d::Zero();
  for (const Ray& ray : rays) {
    const Matrix3d P = Matrix3d::Identity() - ray.direction * ray.direction.transpose();
    A += P;
    b += P * ray.centre;
  }
  return A.ldlt().solve(b);
}

struct NormalEquations {
  Matrix3d H = Matrix3d::Zero();
  Vector3d g = Vector3d::Zero();
  double cost = 0.0;  // sum of squared sines
  double nearest = std::numeric_limits<double>::infinity();
};

/// Residual (I - d d^T) u with u = (X - C) / rho, of length sin(angle). With c = d.u and w = d - c
/// u: J^T J = (I - u u^T - w w^T) / rho^2 and J^T r = -c w / rho.
NormalEquations Linearise(const Rays& rays, const Vector3d& X) {
  NormalEquations n;
  for (const Ray& ray : rays) {
    const Vector3d v = X - ray.centre;
    const double rho = v.norm();
    const double inverse = 1.0 / rho;
    const Vector3d u = v * inverse;
    const double c = ray.direction.dot(u);
    const Vector3d w = ray.direction - c * u;
    n.H += (inverse * inverse) * (Matrix3d::Identity() - u * u.transpose() - w * w.transpose());
    n.g -= (c * inverse) * w;
    n.cost += w.squaredNorm();
    n.nearest = std::min(n.nearest, rho);
  }
  return n;
}

bool InFrontOfAll(const Rays& rays, const Vector3d& X) {
  return std::all_of(rays.begin(), rays.end(), [&](const Ray& ray) {
    return ray.direction.dot(X - ray.centre) > 0.0;  // also false for NaN
  });
}

}  // namespace

Rays RaysFromFirstCamera(std::span<const Rigid3> cams_from_world,
                         std::span<const Vector3d> bearings) {
  Rays rays(bearings.size());
  const Vector3d origin = cams_from_world[0].Centre();
  for (size_t i = 0; i < rays.size(); ++i) {
    rays[i].centre = cams_from_world[i].Centre() - origin;
    rays[i].direction = cams_from_world[i].rotation.conjugate() * bearings[i];
  }
  return rays;
}

std::optional<Vector3d> IntersectRays(const Rays& rays) {
  if (rays.size() < 2 || AllParallel(rays)) return std::nullopt;
  Vector3d X = NearestToLines(rays);
  NormalEquations n = Linearise(rays, X);
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vector3d delta = -n.H.ldlt().solve(n.g);
    const NormalEquations next = Linearise(rays, X + delta);
    if (!(next.cost < n.cost)) break;
    X += delta;
    n = next;
    if (delta.norm() < kStepTolerance * n.nearest) break;
  }
  if (!InFrontOfAll(rays, X)) return std::nullopt;
  return X;
}

}  // namespace orbweave
