// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/difference_solver.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

// Three nodes in a triangle and two in a pair.
const std::vector<GraphEdge> kEdges = {{0, 1}, {2, 1}, {0, 2}, {4, 3}};

TEST(DifferenceSolver, SolvesTheNormalEquations) {
  DifferenceSolver solver(5, kEdges);
  const Eigen::Vector4d weights(1.0, 2.0, 3.0, 4.0);
  Eigen::MatrixXd differences(4, 2);
  differences << 1.0, 0.0, -2.0, 1.0, 0.5, 3.0, 7.0, -7.0;
  const auto values = solver.Solve(weights, differences);
  ASSERT_TRUE(values.has_value());
  // A^T W (A x - d) = 0, with the rows of A as the edges say.
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(4, 5);
  for (size_t e = 0; e < kEdges.size(); ++e) {
    A(static_cast<Eigen::Index>(e), kEdges[e].a) = -1.0;
    A(static_cast<Eigen::Index>(e), kEdges[e].b) = 1.0;
  }
  const Eigen::MatrixXd gradient =
      A.transpose() * weights.asDiagonal() * (A * *values - differences);
  EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(values->row(0).norm(), 0.0);
  EXPECT_EQ(values->row(3).norm(), 0.0);
}

TEST(DifferenceSolver, HoldsTheSmallestNodeOfEachPart) {
  const DifferenceSolver solver(6, kEdges);
  EXPECT_TRUE(solver.IsHeld(0));
  EXPECT_FALSE(solver.IsHeld(1));
  EXPECT_FALSE(solver.IsHeld(2));
  EXPECT_TRUE(solver.IsHeld(3));
  EXPECT_FALSE(solver.IsHeld(4));
  EXPECT_TRUE(solver.IsHeld(5));
}

TEST(DifferenceSolver, ForgetsTheWeightsOfTheSolutionBefore) {
  DifferenceSolver solver(3, {{0, 1}, {1, 2}, {0, 2}});
  const Eigen::Vector3d differences(1.0, 1.0, 3.0);
  const auto first = solver.Solve(Eigen::Vector3d(1.0, 2.0, 5.0), differences);
  (void)solver.Solve(Eigen::Vector3d(9.0, 9.0, 1.0), differences);
  const auto again = solver.Solve(Eigen::Vector3d(1.0, 2.0, 5.0), differences);
  EXPECT_EQ(*first, *again);
}

TEST(DifferenceSolver, HasNothingToSolveWithoutEdges) {
  DifferenceSolver solver(2, {});
  const auto values = solver.Solve(Eigen::VectorXd(0), Eigen::MatrixXd(0, 3));
  ASSERT_TRUE(values.has_value());
  EXPECT_EQ(*values, Eigen::MatrixXd::Zero(2, 3));
}

}  // namespace
}  // namespace orbweave
