// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace orbweave {

/// Eigenvalues, ascending, and their unit eigenvectors, the columns of V: A = V diag(values) V^T.
template <int N>
struct SymmetricEigen {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;
};

/// Of a symmetric matrix, of which the lower triangle is read (Eigen's SelfAdjointEigenSolver,
/// which takes four seconds to compile in each file that has it of its own). Of 2 and 3 rows.
template <int N>
[[nodiscard]] SymmetricEigen<N> EigenOf(const Eigen::Matrix<double, N, N>& A);

extern template SymmetricEigen<2> EigenOf<2>(const Eigen::Matrix2d& A);
extern template SymmetricEigen<3> EigenOf<3>(const Eigen::Matrix3d& A);

}  // namespace orbweave
