// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/refine_absolute_pose.h"

#include <gtest/gtest.h>

#include "tests/support/numeric_jacobian.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::VectorXd;
using testing::MakeResectionWorld;
using testing::ResectionWorld;
using testing::RotationError;

Rigid3 Disturbed(const Rigid3& pose) {
  Eigen::Matrix<double, 6, 1> delta;
  delta << 0.03, -0.02, 0.04, 0.3, -0.2, 0.1;
  return MovePose(pose, delta);
}

TEST(MovePose, MovesPointsAsDocumented) {
  const ResectionWorld world = MakeResectionWorld(1, 1);
  Eigen::Matrix<double, 6, 1> delta;
  delta << 0.3, -0.2, 0.4, 1.0, 2.0, -3.0;
  const Eigen::Vector3d v = world.cam_from_world * world.points_in_world[0];
  const Eigen::Vector3d expected = RotationFromVector(delta.head<3>()) * (v - delta.tail<3>());
  EXPECT_LT((MovePose(world.cam_from_world, delta) * world.points_in_world[0] - expected).norm(),
            1e-12);
}

TEST(LineariseTangentResiduals, HasTheGradientOfItsCost) {
  const ResectionWorld world = MakeResectionWorld(2, 30, 0.3, 1e-3);
  const Rigid3 pose = Disturbed(world.cam_from_world);
  for (const double loss_scale : {0.01, 0.3, 100.0}) {
    const auto cost = [&](const VectorXd& delta) -> VectorXd {
      const Rigid3 moved = MovePose(pose, delta);
      return VectorXd::Constant(
          1,
          LineariseTangentResiduals(moved, world.bearings, world.points_in_world, loss_scale).cost);
    };
    const VectorXd numeric = 0.5 * NumericJacobian(cost, VectorXd::Zero(6)).transpose();
    const auto analytic =
        LineariseTangentResiduals(pose, world.bearings, world.points_in_world, loss_scale);
    EXPECT_LT((numeric - analytic.g).norm(), 1e-5 * analytic.g.norm()) << loss_scale;
  }
}

TEST(LineariseTangentResiduals, HasTheHessianOfItsCostWhereTheDataFit) {
  const ResectionWorld world = MakeResectionWorld(3, 30);
  const auto gradient = [&](const VectorXd& delta) -> VectorXd {
    return LineariseTangentResiduals(
               MovePose(world.cam_from_world, delta), world.bearings, world.points_in_world, 0.1)
        .g;
  };
  const Eigen::MatrixXd numeric = NumericJacobian(gradient, VectorXd::Zero(6));
  const auto analytic =
      LineariseTangentResiduals(world.cam_from_world, world.bearings, world.points_in_world, 0.1);
  const Eigen::MatrixXd H = analytic.H.selfadjointView<Eigen::Lower>();
  EXPECT_LT((numeric - H).norm(), 1e-5 * H.norm());
}

TEST(MinimiseTangentResiduals, ReturnsFromAfar) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const ResectionWorld world = MakeResectionWorld(seed, 50);
    const Rigid3 refined = MinimiseTangentResiduals(Disturbed(world.cam_from_world),
                                                    world.bearings,
                                                    world.points_in_world,
                                                    0.1,
                                                    kMaxRefinementSteps);
    EXPECT_LT(RotationError(refined.rotation, world.cam_from_world.rotation), 1e-7) << seed;
    EXPECT_LT((refined.Centre() - world.cam_from_world.Centre()).norm(), 1e-6) << seed;
  }
}

TEST(MinimiseTangentResiduals, PullsPointsFromTheAntipodeToTheRightSide) {
  // Half a turn off: every point lies behind its bearing or nearly so.
  const ResectionWorld world = MakeResectionWorld(4, 50);
  Rigid3 turned = world.cam_from_world;
  turned = Rigid3{RotationFromVector({0.0, 2.8, 0.0}), Eigen::Vector3d::Zero()} * turned;
  const Rigid3 refined =
      MinimiseTangentResiduals(turned, world.bearings, world.points_in_world, 10.0, 100);
  EXPECT_LT(RotationError(refined.rotation, world.cam_from_world.rotation), 1e-3);
}

TEST(MinimiseTangentResiduals, KeepsTheStartWithoutData) {
  const Rigid3 start = MakeResectionWorld(5, 0).cam_from_world;
  const Rigid3 refined = MinimiseTangentResiduals(start, {}, {}, 0.1, kMaxRefinementSteps);
  EXPECT_EQ(refined.translation, start.translation);
}

}  // namespace
}  // namespace orbweave
