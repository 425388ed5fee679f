// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/ray_maps.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "core/base/status.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kRankTolerance = 1e-10;  // of squared singular values where these are at hand

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

}  // namespace orbweave
