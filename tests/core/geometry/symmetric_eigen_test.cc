// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/symmetric_eigen.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

template <int N>
void ExpectDecomposed(const Eigen::Matrix<double, N, N>& A) {
  const SymmetricEigen<N> eigen = EigenOf<N>(A);
  const Eigen::Matrix<double, N, N> again =
      eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose();
  EXPECT_LT((again - A).norm(), 1e-13 * (1.0 + A.norm()));
  EXPECT_TRUE(eigen.vectors.isUnitary(1e-13));
  for (int i = 0; i + 1 < N; ++i) EXPECT_LE(eigen.values[i], eigen.values[i + 1]);
}

TEST(EigenOf, TakesSymmetricMatricesApart) {
  for (int seed = 0; seed < 20; ++seed) {
    std::srand(static_cast<unsigned>(seed));
    const Eigen::Matrix2d two = Eigen::Matrix2d::Random();
    const Eigen::Matrix3d three = Eigen::Matrix3d::Random();
    ExpectDecomposed<2>(two + two.transpose());
    ExpectDecomposed<3>(three * three.transpose());
  }
  ExpectDecomposed<3>(Eigen::Matrix3d::Zero());
  ExpectDecomposed<2>(5.0 * Eigen::Matrix2d::Identity());
}

}  // namespace
}  // namespace orbweave
