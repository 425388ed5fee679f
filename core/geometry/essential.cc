// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/essential.h"

#include <Eigen/SVD>

#include "core/geometry/rotation.h"

namespace orbweave {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d EssentialFromPose(const Rigid3& b_from_a) {
  return SkewSymmetric(b_from_a.translation) * b_from_a.rotation.toRotationMatrix();
}

std::array<Rigid3, 4> PosesFromEssential(const Matrix3d& E) {
  const Matrix3d F = std::sqrt(2.0) / E.norm() * E;
  // cof(F) = T T^T R: its columns are multiples of T, the left null vector.
  Matrix3d cofactors;
  cofactors.row(0) = F.row(1).cross(F.row(2));
  cofactors.row(1) = F.row(2).cross(F.row(0));
  cofactors.row(2) = F.row(0).cross(F.row(1));
  int column = 0;
  cofactors.colwise().squaredNorm().maxCoeff(&column);
  const Vector3d T = cofactors.col(column).normalized();
  const Matrix3d TF = SkewSymmetric(T) * F;
  const Eigen::Quaterniond R = Eigen::Quaterniond(Matrix3d(cofactors - TF)).normalized();
  const Eigen::Quaterniond R_turned = Eigen::Quaterniond(Matrix3d(cofactors + TF)).normalized();
  return {Rigid3{R, T}, Rigid3{R, -T}, Rigid3{R_turned, T}, Rigid3{R_turned, -T}};
}

Matrix3d NearestEssential(const Matrix3d& M) {
  const Eigen::JacobiSVD<Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * Vector3d(1.0, 1.0, 0.0).asDiagonal() * svd.matrixV().transpose();
}

}  // namespace orbweave
