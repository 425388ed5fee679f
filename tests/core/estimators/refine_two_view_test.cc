// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/refine_two_view.h"

#include <gtest/gtest.h>

#include "core/geometry/epipolar.h"
#include "core/geometry/essential.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::VectorXd;
using testing::MakeTwoViewWorld;
using testing::RotationError;
using testing::TwoViewWorld;

Rigid3 Disturbed(const Rigid3& pose) {
  Eigen::Matrix<double, 5, 1> delta;
  delta << 0.02, -0.03, 0.01, 0.05, -0.04;
  return MoveRelativePose(pose, delta);
}

TEST(MoveRelativePose, KeepsTheUnitBaseline) {
  const Rigid3 moved = Disturbed(MakeTwoViewWorld(1, 0).b_from_a);
  EXPECT_NEAR(moved.translation.norm(), 1.0, 1e-14);
  EXPECT_NEAR(moved.rotation.norm(), 1.0, 1e-14);
}

TEST(LineariseEpipolarResiduals, MeasuresTheSymmetricEpipolarAngle) {
  const TwoViewWorld world = MakeTwoViewWorld(1, 1, 1.0);
  const double sine =
      std::sin(SymmetricEpipolarAngle(world.b_from_a, world.bearings_a[0], world.bearings_b[0]));
  EXPECT_NEAR(
      LineariseEpipolarResiduals(world.b_from_a, world.bearings_a, world.bearings_b, 1e4).cost,
      sine * sine,
      1e-8);
}

TEST(LineariseEpipolarResiduals, HasTheGradientOfItsCost) {
  const TwoViewWorld world = MakeTwoViewWorld(2, 30, 0.3, 1e-3);
  const Rigid3 pose = Disturbed(world.b_from_a);
  for (const double loss_scale : {0.01, 0.3, 100.0}) {
    const auto cost = [&](const VectorXd& delta) -> VectorXd {
      const Rigid3 moved = MoveRelativePose(pose, delta);
      return VectorXd::Constant(
          1,
          LineariseEpipolarResiduals(moved, world.bearings_a, world.bearings_b, loss_scale).cost);
    };
    const VectorXd numeric = 0.5 * NumericJacobian(cost, VectorXd::Zero(5)).transpose();
    const auto analytic =
        LineariseEpipolarResiduals(pose, world.bearings_a, world.bearings_b, loss_scale);
    EXPECT_LT((numeric - analytic.g).norm(), 1e-5 * analytic.g.norm()) << loss_scale;
  }
}

TEST(LineariseEpipolarResiduals, IsTheSameForAllPosesOfAnEssentialMatrix) {
  const TwoViewWorld world = MakeTwoViewWorld(3, 30, 0.3, 1e-3);
  const double cost =
      LineariseEpipolarResiduals(world.b_from_a, world.bearings_a, world.bearings_b, 0.01).cost;
  for (const Rigid3& pose : PosesFromEssential(EssentialFromPose(world.b_from_a))) {
    EXPECT_NEAR(LineariseEpipolarResiduals(pose, world.bearings_a, world.bearings_b, 0.01).cost,
                cost,
                1e-9 * cost);
  }
}

TEST(MinimiseEpipolarResiduals, ReturnsToThePoseOfCleanData) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const TwoViewWorld world = MakeTwoViewWorld(seed, 100);
    const Rigid3 refined = MinimiseEpipolarResiduals(
        Disturbed(world.b_from_a), world.bearings_a, world.bearings_b, 0.1, 20);
    EXPECT_LT(RotationError(refined.rotation, world.b_from_a.rotation), 1e-7) << seed;
    EXPECT_LT(AngleBetween(refined.translation, world.b_from_a.translation), 1e-7) << seed;
  }
}

TEST(MinimiseEpipolarResiduals, StaysFiniteWhenTheBaselineIsFree) {
  const TwoViewWorld world = MakeTwoViewWorld(4, 50);
  std::vector<Eigen::Vector3d> turned;
  for (const auto& bearing : world.bearings_a) turned.push_back(world.b_from_a.rotation * bearing);
  const Rigid3 refined =
      MinimiseEpipolarResiduals(Disturbed(world.b_from_a), world.bearings_a, turned, 0.1, 20);
  EXPECT_TRUE(refined.translation.allFinite());
  EXPECT_LT(RotationError(refined.rotation, world.b_from_a.rotation), 1e-6);
}

}  // namespace
}  // namespace orbweave
