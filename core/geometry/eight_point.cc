// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/eight_point.h"

#include <Eigen/SVD>

#include "core/base/status.h"
#include "core/geometry/essential.h"

namespace orbweave {
namespace {

constexpr double kRankTolerance = 1e-10;

}  // namespace

std::optional<Eigen::Matrix3d> SolveEightPoint(std::span<const Eigen::Vector3d> bearings_a,
                                               std::span<const Eigen::Vector3d> bearings_b) {
  ORBWEAVE_CHECK(bearings_a.size() == bearings_b.size());
  const auto count = static_cast<Eigen::Index>(bearings_a.size());
  if (count < 8) return std::nullopt;
  Eigen::Matrix<double, Eigen::Dynamic, 9> A(count, 9);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (int row = 0; row < 3; ++row)
      A.row(i).segment<3>(3 * row) = bearings_b[i][row] * bearings_a[i].transpose();
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullV);
  const auto& singular_values = svd.singularValues();
  if (!(singular_values[7] > kRankTolerance * singular_values[0])) return std::nullopt;
  const Eigen::Matrix<double, 9, 1> e = svd.matrixV().col(8);
  Eigen::Matrix3d M;
  M << e.segment<3>(0).transpose(), e.segment<3>(3).transpose(), e.segment<3>(6).transpose();
  return NearestEssential(M);
}

}  // namespace orbweave
