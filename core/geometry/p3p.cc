// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/p3p.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/real_roots.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kCollinearSin = 1e-6;
constexpr double kRounding = 1e-13;
constexpr int kNewtonSteps = 2;

/// lambda^T M lambda = a for the pairs (0, 1), (0, 2), (1, 2).
struct DistanceQuadrics {
  std::array<Matrix3d, 3> M{};
  std::array<double, 3> a{};
};

Matrix3d DistanceForm(int i, int j, double cosine) {
  Matrix3d M = Matrix3d::Zero();
  M(i, i) = 1.0;
  M(j, j) = 1.0;
  M(i, j) = -cosine;
  M(j, i) = -cosine;
  return M;
}

DistanceQuadrics MakeQuadrics(std::span<const Vector3d, 3> b, std::span<const Vector3d, 3> P) {
  return {
      .M = {DistanceForm(0, 1, b[0].dot(b[1])),
            DistanceForm(0, 2, b[0].dot(b[2])),
            DistanceForm(1, 2, b[1].dot(b[2]))},
      .a = {(P[0] - P[1]).squaredNorm(), (P[0] - P[2]).squaredNorm(), (P[1] - P[2]).squaredNorm()}};
}

Matrix3d SymmetricAdjugate(const Matrix3d& D) {
  Matrix3d A;
  A.col(0) = D.col(1).cross(D.col(2));
  A.col(1) = D.col(2).cross(D.col(0));
  A.col(2) = D.col(0).cross(D.col(1));
  return A;
}

/// The two real lines of a degenerate conic D = (l m^T + m l^T) / 2, whose adjugate is -p p^T with
/// p proportional to l x m: then D + [p]x has rank one.
struct LinePair {
  Vector3d l = Vector3d::Zero();
  Vector3d m = Vector3d::Zero();
  double squared_sine = -1.0;  // how far from complex the lines are; negative: complex
};

LinePair SplitConic(const Matrix3d& D) {
  const Matrix3d B = -SymmetricAdjugate(D / D.cwiseAbs().maxCoeff());
  LinePair lines;
  int i = 0;
  lines.squared_sine = B.diagonal().maxCoeff(&i);
  if (!(lines.squared_sine > -kRounding)) return lines;
  const double beta = std::sqrt(std::max(lines.squared_sine, kRounding));
  const Matrix3d C = D / D.cwiseAbs().maxCoeff() + SkewSymmetric(B.col(i) / beta);
  int row = 0;
  int column = 0;
  C.cwiseAbs().maxCoeff(&row, &column);
  lines.l = C.row(row).transpose().normalized();
  lines.m = C.col(column).normalized();
  return lines;
}

/// The line pair of the pencil D1 + g D2, g real or infinite, that is furthest from complex, and a
/// conic of the pencil to cut it with.
struct Split {
  LinePair lines{};
  Matrix3d other = Matrix3d::Zero();
};

Split BestSplit(const Matrix3d& D1, const Matrix3d& D2) {
  const Matrix3d A1 = SymmetricAdjugate(D1);
  const Matrix3d A2 = SymmetricAdjugate(D2);
  const std::array<double, 4> cubic = {D1.col(0).dot(A1.col(0)),
                                       A1.cwiseProduct(D2).sum(),
                                       A2.cwiseProduct(D1).sum(),
                                       D2.col(0).dot(A2.col(0))};
  Split best{.other = D2};
  for (const double g : RealRoots(cubic)) {
    const LinePair lines = SplitConic(D1 + g * D2);
    if (lines.squared_sine > best.lines.squared_sine) best.lines = lines;
  }
  const double largest = D2.cwiseAbs().maxCoeff();
  if (std::abs(cubic[3]) < kRounding * largest * largest * largest) {  // isosceles: g is infinite
    const LinePair lines = SplitConic(D2);
    if (lines.squared_sine > best.lines.squared_sine) best = {.lines = lines, .other = D1};
  }
  return best;
}

/// The points of a line on a conic, as homogeneous vectors of any sign: none or two.
absl::InlinedVector<Vector3d, 2> Intersect(const Vector3d& line, const Matrix3d& D) {
  const Eigen::Matrix<double, 3, 2> basis = TangentBasis(line);
  const Eigen::Matrix2d Q = basis.transpose() * D * basis;
  const double discriminant = Q(0, 1) * Q(0, 1) - Q(0, 0) * Q(1, 1);
  if (!(discriminant >= -kRounding * Q.squaredNorm())) return {};
  const double q = -(Q(0, 1) + std::copysign(std::sqrt(std::max(0.0, discriminant)), Q(0, 1)));
  return {basis * Eigen::Vector2d(q, Q(0, 0)), basis * Eigen::Vector2d(Q(1, 1), q)};
}

/// Scales a direction to the distances and polishes them with Newton's method on the three
/// quadrics.
Vector3d DistancesAlong(const Vector3d& direction, const DistanceQuadrics& quadrics) {
  const Matrix3d sum = quadrics.M[0] + quadrics.M[1] + quadrics.M[2];
  const double a = quadrics.a[0] + quadrics.a[1] + quadrics.a[2];
  Vector3d lambda = std::sqrt(a / direction.dot(sum * direction)) * direction;
  for (int step = 0; step < kNewtonSteps; ++step) {
    Matrix3d J;
    Vector3d residual;
    for (int k = 0; k < 3; ++k) {
      const Vector3d row = quadrics.M[k] * lambda;
      J.row(k) = 2.0 * row.transpose();
      residual[k] = lambda.dot(row) - quadrics.a[k];
    }
    const Vector3d delta = J.inverse() * residual;
    if (!delta.allFinite() || delta.norm() > 0.1 * lambda.norm()) break;  // a double solution
    lambda -= delta;
  }
  return lambda;
}

/// Right-handed orthonormal frame of a triangle.
Matrix3d TriangleFrame(const Vector3d& p0, const Vector3d& p1, const Vector3d& p2) {
  Matrix3d F;
  F.col(0) = (p1 - p0).normalized();
  F.col(2) = (p1 - p0).cross(p2 - p0).normalized();
  F.col(1) = F.col(2).cross(F.col(0));
  return F;
}

Rigid3 PoseFromDistances(const Vector3d& lambda,
                         std::span<const Vector3d, 3> b,
                         std::span<const Vector3d, 3> P) {
  const std::array<Vector3d, 3> Q = {lambda[0] * b[0], lambda[1] * b[1], lambda[2] * b[2]};
  const Matrix3d R = TriangleFrame(Q[0], Q[1], Q[2]) * TriangleFrame(P[0], P[1], P[2]).transpose();
  const Vector3d t = (Q[0] + Q[1] + Q[2] - R * (P[0] + P[1] + P[2])) / 3.0;
  return {Eigen::Quaterniond(R).normalized(), t};
}

bool AreCollinear(std::span<const Vector3d, 3> P) {
  const Vector3d u = P[1] - P[0];
  const Vector3d v = P[2] - P[0];
  const Vector3d w = P[2] - P[1];
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()});
  return !(u.cross(v).norm() > kCollinearSin * longest);
}

}  // namespace

absl::InlinedVector<Rigid3, 4> SolveP3p(std::span<const Vector3d, 3> bearings,
                                        std::span<const Vector3d, 3> points_in_world) {
  absl::InlinedVector<Rigid3, 4> poses;
  if (AreCollinear(points_in_world)) return poses;
  const DistanceQuadrics quadrics = MakeQuadrics(bearings, points_in_world);
  const auto& [M, a] = quadrics;
  const double scale = 1.0 / (a[0] + a[1] + a[2]);
  const Matrix3d D1 = scale * (a[2] * M[0] - a[0] * M[2]);
  const Matrix3d D2 = scale * (a[2] * M[1] - a[1] * M[2]);
  const Split split = BestSplit(D1, D2);
  if (!(split.lines.squared_sine > -kRounding)) return poses;
  for (const Vector3d& line : {split.lines.l, split.lines.m}) {
    for (Vector3d direction : Intersect(line, split.other)) {
      if (direction.sum() < 0.0) direction = -direction;
      if (!(direction.minCoeff() > 0.0)) continue;
      const Vector3d lambda = DistancesAlong(direction, quadrics);
      if (!(lambda.minCoeff() > 0.0) || !lambda.allFinite()) continue;
      const Rigid3 pose = PoseFromDistances(lambda, bearings, points_in_world);
      if (pose.rotation.coeffs().allFinite()) poses.push_back(pose);
    }
  }
  return poses;
}

}  // namespace orbweave
