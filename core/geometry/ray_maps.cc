// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/ray_maps.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "core/base/status.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kRankTolerance = 1e-10;  // of squared singular values where these are at hand

/// Four unit rays: X holds three of them, and the fourth is X w.
struct ProjectiveFrame {
  Matrix3d X = Matrix3d::Zero();
  Vector3d w = Vector3d::Zero();
};

/// nullopt: three of the rays lie in a plane.
std::optional<ProjectiveFrame> FrameOf(std::span<const Vector3d> rays) {
  constexpr double kFlat = 1e-7;  // volume of a parallelepiped of unit rays
  ProjectiveFrame frame;
  frame.X << rays[0], rays[1], rays[2];
  const double volume = frame.X.determinant();
  const Vector3d volumes(rays[3].dot(rays[1].cross(rays[2])),
                         rays[3].dot(rays[2].cross(rays[0])),
                         rays[3].dot(rays[0].cross(rays[1])));
  if (!(std::min(std::abs(volume), volumes.cwiseAbs().minCoeff()) > kFlat)) return std::nullopt;
  frame.w = volumes / volume;
  return frame;
}

/// The map of four rays, H = Y diag(w_b / w_a) X^-1 (Hartley, Zisserman: Multiple View Geometry, on
/// projective frames). What sees one side of a plane maps each ray to its counterpart and none to
/// the opposite one: all of the quotients are positive, or the four are not of one plane.
std::optional<Matrix3d> HomographyOfFour(std::span<const Vector3d> bearings_a,
                                         std::span<const Vector3d> bearings_b) {
  const std::optional<ProjectiveFrame> a = FrameOf(bearings_a);
  const std::optional<ProjectiveFrame> b = FrameOf(bearings_b);
  if (!a || !b) return std::nullopt;
  const Vector3d scales = b->w.cwiseQuotient(a->w);
  if (!(scales.minCoeff() > 0.0)) return std::nullopt;
  return Matrix3d(b->X * scales.asDiagonal() * a->X.inverse()).normalized();
}

}  // namespace

std::optional<Matrix3d> FitRayRotation(std::span<const Vector3d> bearings_a,
                                       std::span<const Vector3d> bearings_b) {
  ORBWEAVE_CHECK(bearings_a.size() == bearings_b.size());
  Matrix3d M = Matrix3d::Zero();
  for (size_t i = 0; i < bearings_a.size(); ++i) M += bearings_b[i] * bearings_a[i].transpose();
  const Eigen::JacobiSVD<Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (!(svd.singularValues()[1] > kRankTolerance * svd.singularValues()[0])) return std::nullopt;
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * Vector3d(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
}

std::optional<Matrix3d> FitRayHomography(std::span<const Vector3d> bearings_a,
                                         std::span<const Vector3d> bearings_b) {
  ORBWEAVE_CHECK(bearings_a.size() == bearings_b.size());
  if (bearings_a.size() < 4) return std::nullopt;
  if (bearings_a.size() == 4) return HomographyOfFour(bearings_a, bearings_b);
  Eigen::Matrix<double, 9, 9> AtA = Eigen::Matrix<double, 9, 9>::Zero();
  for (size_t i = 0; i < bearings_a.size(); ++i) {
    const Eigen::Matrix<double, 3, 2> B = TangentBasis(bearings_b[i]);
    for (int k = 0; k < 2; ++k) {
      Eigen::Matrix<double, 9, 1> row;
      row << B(0, k) * bearings_a[i], B(1, k) * bearings_a[i], B(2, k) * bearings_a[i];
      AtA += row * row.transpose();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> eigen(AtA);
  if (!(eigen.eigenvalues()[1] > kRankTolerance * eigen.eigenvalues()[8])) return std::nullopt;
  const Eigen::Matrix<double, 9, 1> h = eigen.eigenvectors().col(0);
  Matrix3d H;
  H << h.segment<3>(0).transpose(), h.segment<3>(3).transpose(), h.segment<3>(6).transpose();
  int num_same_side = 0;
  for (size_t i = 0; i < bearings_a.size(); ++i)
    num_same_side += bearings_b[i].dot(H * bearings_a[i]) > 0.0 ? 1 : -1;
  if (num_same_side < 0) H = -H;
  return H;
}

std::optional<Matrix3d> FitRayPlane(const Rigid3& b_from_a,
                                    std::span<const Vector3d> bearings_a,
                                    std::span<const Vector3d> bearings_b) {
  ORBWEAVE_CHECK(bearings_a.size() == bearings_b.size());
  constexpr double kFlat = 1e-12;  // determinant over the cube of the trace
  if (bearings_a.size() < 3) return std::nullopt;
  const Matrix3d R = b_from_a.rotation.toRotationMatrix();
  const Vector3d& t = b_from_a.translation;
  Matrix3d AtA = Matrix3d::Zero();
  Vector3d Aty = Vector3d::Zero();
  for (size_t i = 0; i < bearings_a.size(); ++i) {
    const Vector3d along = bearings_b[i].cross(t);
    const Vector3d still = bearings_b[i].cross(R * bearings_a[i]);
    AtA += along.squaredNorm() * bearings_a[i] * bearings_a[i].transpose();
    Aty -= along.dot(still) * bearings_a[i];
  }
  const double trace = AtA.trace();
  if (!(AtA.determinant() > kFlat * trace * trace * trace)) return std::nullopt;
  const Vector3d n = AtA.inverse() * Aty;
  const auto is_in_front = [&](const Vector3d& bearing) { return n.dot(bearing) > 0.0; };
  if (bearings_a.size() == 3 && !std::ranges::all_of(bearings_a, is_in_front)) return std::nullopt;
  return R + t * n.transpose();
}

}  // namespace orbweave
