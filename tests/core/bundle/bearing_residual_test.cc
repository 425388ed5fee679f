// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/bearing_residual.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "tests/core/bundle/bundle_world.h"
#include "tests/support/numeric_jacobian.h"

namespace orbweave {
namespace {

// A bearing at `angle_rad` from the ray to the point.
Eigen::Vector3d BearingAtAngle(const Eigen::Vector3d& ray_in_cam,
                               double angle_rad,
                               Random& random) {
  const Eigen::Vector3d axis = ray_in_cam.cross(RandomVector(random)).normalized();
  return RotationFromVector(angle_rad * axis) * ray_in_cam.normalized();
}

TEST(BearingResidual, LengthIsTheAngleUpToTheAntipode) {
  Random random(1);
  for (const double angle_rad : {0.0, 1e-9, 1e-4, 0.1, 1.5, 3.0, 3.14159, std::numbers::pi}) {
    const Eigen::Matrix3d R = RotationFromVector(RandomVector(random)).toRotationMatrix();
    const Eigen::Vector3d C = RandomVector(random);
    const Eigen::Vector3d X = 5.0 * RandomVector(random);
    const Eigen::Vector3d bearing = BearingAtAngle(R * (X - C), angle_rad, random);
    const BearingResidual residual = EvaluateBearingResidual(R, C, X, bearing);
    EXPECT_NEAR(residual.r.norm(), angle_rad, 1e-12);
    EXPECT_TRUE(residual.d_pose.allFinite());
    EXPECT_TRUE(residual.d_point.allFinite());
  }
}

TEST(BearingResidual, JacobiansAgreeWithNumericOnes) {
  Random random(2);
  for (const double angle_rad : {1e-3, 0.2, 1.2, 2.0, 2.9}) {
    for (int trial = 0; trial < 10; ++trial) {
      const Eigen::Quaterniond R = RotationFromVector(RandomVector(random));
      const Eigen::Vector3d C = RandomVector(random);
      const Eigen::Vector3d X = 5.0 * RandomVector(random);
      const Eigen::Vector3d bearing = BearingAtAngle(R * (X - C), angle_rad, random);
      const auto f = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        const Eigen::Matrix3d turned = (R * RotationFromVector(x.head<3>())).toRotationMatrix();
        return EvaluateBearingResidual(turned, C + x.segment<3>(3), X + x.tail<3>(), bearing).r;
      };
      const Eigen::MatrixXd numeric = NumericJacobian(f, Eigen::VectorXd::Zero(9));
      const BearingResidual residual = EvaluateBearingResidual(R.toRotationMatrix(), C, X, bearing);
      const double size = 1.0 + numeric.norm();
      EXPECT_LT((residual.d_pose - numeric.leftCols<6>()).norm(), 1e-7 * size) << angle_rad;
      EXPECT_LT((residual.d_point - numeric.rightCols<3>()).norm(), 1e-7 * size) << angle_rad;
    }
  }
}

TEST(BearingResidual, GradientStaysExactNearTheAntipode) {
  Random random(3);
  const Eigen::Vector3d C = RandomVector(random);
  const Eigen::Vector3d X = 5.0 * RandomVector(random);
  const Eigen::Vector3d bearing = BearingAtAngle(X - C, std::numbers::pi - 0.02, random);
  const auto cost = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    const BearingResidual residual =
        EvaluateBearingResidual(Eigen::Matrix3d::Identity(), C, x, bearing);
    return Eigen::VectorXd::Constant(1, 0.5 * residual.r.squaredNorm());
  };
  const BearingResidual residual =
      EvaluateBearingResidual(Eigen::Matrix3d::Identity(), C, X, bearing);
  const Eigen::RowVector3d numeric = NumericJacobian(cost, X);
  EXPECT_LT((residual.r.transpose() * residual.d_point - numeric).norm(), 1e-6 * numeric.norm());
  EXPECT_GT(numeric.norm(), 0.1);
}

TEST(BearingResidual, SpeaksNotOfThePanoramasOwnRotation) {
  Random random(4);
  const Eigen::Quaterniond R = RotationFromVector(RandomVector(random));
  const Eigen::Quaterniond turn = RotationFromVector(RandomVector(random));
  const Eigen::Vector3d C = RandomVector(random);
  const Eigen::Vector3d X = 5.0 * RandomVector(random);
  const Eigen::Vector3d bearing = BearingAtAngle(R * (X - C), 0.3, random);
  const BearingResidual before = EvaluateBearingResidual(R.toRotationMatrix(), C, X, bearing);
  const BearingResidual after =
      EvaluateBearingResidual((turn * R).toRotationMatrix(), C, X, turn * bearing);
  // The tangent axes differ by a rotation in the plane; J^T J and J^T r do not.
  EXPECT_LT(
      (before.d_pose.transpose() * before.d_pose - after.d_pose.transpose() * after.d_pose).norm(),
      1e-12);
  EXPECT_LT((before.d_point.transpose() * before.r - after.d_point.transpose() * after.r).norm(),
            1e-12);
}

TEST(BearingResidual, IsZeroForAPointInTheCentre) {
  const Eigen::Vector3d C(1, 2, 3);
  const BearingResidual residual =
      EvaluateBearingResidual(Eigen::Matrix3d::Identity(), C, C, Eigen::Vector3d::UnitX());
  EXPECT_EQ(residual.r.norm(), 0.0);
  EXPECT_TRUE(residual.d_point.isZero());
}

}  // namespace
}  // namespace orbweave
