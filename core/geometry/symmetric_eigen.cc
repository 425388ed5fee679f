// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace orbweave {

template <int N>
SymmetricEigen<N> EigenOf(const Eigen::Matrix<double, N, N>& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template SymmetricEigen<2> EigenOf<2>(const Eigen::Matrix2d& A);
template SymmetricEigen<3> EigenOf<3>(const Eigen::Matrix3d& A);

}  // namespace orbweave
