// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/reduced_system.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/bundle/bearing_residual.h"
#include "tests/core/bundle/bundle_world.h"

namespace orbweave {
namespace {

constexpr double kLambda = 1e-4;

// The whole Jacobian and residual, dense, poses first.
struct DenseSystem {
  Eigen::MatrixXd J;
  Eigen::VectorXd r;
};

DenseSystem MakeDense(const BundleProblem& problem) {
  const auto num_poses = static_cast<Eigen::Index>(problem.cams_from_world.size());
  const auto num_points = static_cast<Eigen::Index>(problem.points_in_world.size());
  const auto num_rows = 2 * static_cast<Eigen::Index>(problem.observations.size());
  DenseSystem dense{Eigen::MatrixXd::Zero(num_rows, 6 * num_poses + 3 * num_points),
                    Eigen::VectorXd::Zero(num_rows)};
  for (Eigen::Index k = 0; k < num_rows / 2; ++k) {
    const BundleObservation& seen = problem.observations[static_cast<size_t>(k)];
    const Rigid3& pose = problem.cams_from_world[seen.pose];
    const BearingResidual residual = EvaluateBearingResidual(pose.rotation.toRotationMatrix(),
                                                             pose.Centre(),
                                                             problem.points_in_world[seen.point],
                                                             seen.bearing);
    dense.r.segment<2>(2 * k) = residual.r / seen.sigma_rad;
    dense.J.block<2, 6>(2 * k, 6 * seen.pose) = residual.d_pose / seen.sigma_rad;
    dense.J.block<2, 3>(2 * k, 6 * num_poses + 3 * seen.point) = residual.d_point / seen.sigma_rad;
  }
  return dense;
}

// Damps every 3x3 block by lambda times its mean diagonal entry.
Eigen::MatrixXd Damped(Eigen::MatrixXd H) {
  for (Eigen::Index i = 0; i < H.rows(); i += 3) {
    const double mu = kLambda * H.block<3, 3>(i, i).trace() / 3.0;
    H.block<3, 3>(i, i).diagonal().array() += mu;
  }
  return H;
}

TEST(ReducedSystem, IsTheSchurComplementOfTheDenseSystem) {
  BundleProblem problem = MakeBundleWorld({.num_poses = 5, .num_points = 40}).start;
  // A panorama that sees one point twice.
  problem.observations.push_back(problem.observations.front());
  problem.observations.back().bearing.x() += 1e-3;
  problem.observations.back().bearing.normalize();

  Gauge nothing_held;
  nothing_held.pose_is_held.assign(5, 0);
  const BundleLayout layout = MakeBundleLayout(problem, nothing_held);
  ReducedSystem system = MakeReducedSystem(layout);
  BearingReducer reducer(layout, 1);
  reducer.AddBearings(
      InitialState(problem), RobustLoss(BundleLoss::kLeastSquares, 1.0), kLambda, system);
  DampPoses(kLambda, system);

  const DenseSystem dense = MakeDense(problem);
  const Eigen::Index n = 30;
  const Eigen::Index m = dense.J.cols() - n;
  // Points that nobody sees have empty blocks; one on the diagonal leaves them out.
  Eigen::MatrixXd H = Damped(dense.J.transpose() * dense.J);
  for (Eigen::Index i = n; i < n + m; ++i) {
    if (H(i, i) == 0.0) H(i, i) = 1.0;
  }
  const Eigen::VectorXd g = dense.J.transpose() * dense.r;
  const Eigen::MatrixXd WVinv = H.topRightCorner(n, m) * H.bottomRightCorner(m, m).inverse();
  const Eigen::MatrixXd S = H.topLeftCorner(n, n) - WVinv * H.bottomLeftCorner(m, n);
  const Eigen::VectorXd rhs = -(g.head(n) - WVinv * g.tail(m));
  for (uint32_t j = 0; j < 5; ++j) {
    EXPECT_LT((system.rhs[j] - rhs.segment<6>(6 * j)).norm(), 1e-8 * rhs.norm());
    EXPECT_LT((system.gradient[j] - g.segment<6>(6 * j)).norm(), 1e-10 * g.norm());
    for (uint32_t p = system.S.column_start[j]; p < system.S.column_start[j + 1]; ++p) {
      const auto expected = S.block<6, 6>(6 * system.S.rows[p], 6 * j);
      EXPECT_LT((system.S.values[p] - expected).norm(), 1e-8 * S.norm());
    }
  }
}

TEST(ReducedSystem, HoldsAPoseThatSeesNothing) {
  BundleProblem problem = MakeBundleWorld({.num_poses = 3, .num_points = 30}).start;
  problem.cams_from_world.emplace_back();
  Gauge nothing_held;
  nothing_held.pose_is_held.assign(4, 0);
  const BundleLayout layout = MakeBundleLayout(problem, nothing_held);
  ReducedSystem system = MakeReducedSystem(layout);
  DampPoses(kLambda, system);
  EXPECT_TRUE(system.S.Diagonal(3).isIdentity());
  EXPECT_TRUE(system.rhs[3].isZero());
}

}  // namespace
}  // namespace orbweave
