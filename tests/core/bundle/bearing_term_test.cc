// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/bearing_term.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/bundle/bearing_residual.h"
#include "tests/core/bundle/bundle_world.h"

namespace orbweave {
namespace {

constexpr double kPi = std::numbers::pi;

// On both sides of the switch from series to arc tangent, and behind the bearing.
constexpr double kAngles[] = {
    1e-9, 1e-5, 1e-3, 0.0316, 0.0317, 0.3, 1.5, 1.6, 2.9, kPi - 0.02, kPi - 1e-6};

TEST(BearingTerm, EqualsTheProductsOfTheTangentPlaneJacobians) {
  Random random(1);
  for (const double angle_rad : kAngles) {
    const Eigen::Vector3d C = RandomVector(random);
    const Eigen::Vector3d X = 4.0 * RandomVector(random);
    const Eigen::Vector3d axis = (X - C).cross(RandomVector(random)).normalized();
    const Eigen::Vector3d b = RotationFromVector(angle_rad * axis) * (X - C).normalized();
    const BearingTerm term = LineariseBearing(C, X, b);
    const BearingResidual residual = EvaluateBearingResidual(Eigen::Matrix3d::Identity(), C, X, b);
    const Eigen::Matrix3d hessian = residual.d_point.transpose() * residual.d_point;
    const Eigen::Vector3d gradient = residual.d_point.transpose() * residual.r;
    // At 1e-6 from the antipode the direction away from it is known to 1e-10.
    EXPECT_LT((PointHessian(term, 1.0) - hessian).norm(), 2e-9 * hessian.norm()) << angle_rad;
    EXPECT_LT((PointGradient(term, 1.0) - gradient).norm(), 2e-9 * gradient.norm() + 1e-16)
        << angle_rad;
    EXPECT_NEAR(term.squared_angle, angle_rad * angle_rad, 1e-13 * angle_rad + 1e-24) << angle_rad;
    EXPECT_EQ(EvaluateBearing(C, X, b).squared_angle, term.squared_angle);
    EXPECT_EQ(EvaluateBearing(C, X, b).behind, angle_rad > 0.5 * kPi);
  }
}

TEST(BearingTerm, LeavesTheAntipode) {
  const Eigen::Vector3d C(1, 2, 3);
  const Eigen::Vector3d X(1, 2, 7);
  const BearingTerm term = LineariseBearing(C, X, -Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(term.squared_angle, kPi * kPi, 1e-12);
  EXPECT_NEAR(PointGradient(term, 1.0).norm(), kPi / 4.0, 1e-12);
  EXPECT_TRUE(PointHessian(term, 1.0).allFinite());
}

TEST(BearingTerm, IsZeroForAPointInTheCentre) {
  const BearingTerm term = LineariseBearing({1, 2, 3}, {1, 2, 3}, Eigen::Vector3d::UnitX());
  EXPECT_EQ(PointHessian(term, 1.0).norm(), 0.0);
  EXPECT_EQ(PointGradient(term, 1.0).norm(), 0.0);
}

}  // namespace
}  // namespace orbweave
