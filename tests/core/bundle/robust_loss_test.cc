// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/robust_loss.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

constexpr BundleLoss kLosses[] = {
    BundleLoss::kLeastSquares, BundleLoss::kCauchy, BundleLoss::kHuber};

double Rho(const RobustLoss& loss, double s) {
  RobustLoss::Sum sum(loss);
  sum.Add(s);
  return sum.Value();
}

TEST(RobustLoss, IsTheSquareForSmallResiduals) {
  for (const BundleLoss kind : kLosses) {
    EXPECT_NEAR(Rho(RobustLoss(kind, 2.0), 1e-8), 1e-8, 1e-16);
  }
}

TEST(RobustLoss, WeightAndBendAreItsDerivatives) {
  for (const BundleLoss kind : kLosses) {
    const RobustLoss loss = RobustLoss(kind, 2.0).Bent(true);
    for (const double s : {0.5, 3.0, 5.0, 100.0}) {
      const double h = 1e-4;
      const double first = (Rho(loss, s + h) - Rho(loss, s - h)) / (2.0 * h);
      EXPECT_NEAR(loss.Weight(s), first, 1e-8);
      const double second = (loss.Weight(s + h) - loss.Weight(s - h)) / (2.0 * h);
      EXPECT_NEAR(loss.Bend(s) * loss.Weight(s), 2.0 * second, 1e-8);
    }
  }
}

TEST(RobustLoss, SumsManyHugeResidualsWithoutOverflow) {
  const RobustLoss loss(BundleLoss::kCauchy, 2.0);
  RobustLoss::Sum sum(loss);
  for (int i = 0; i < 1000; ++i) sum.Add(1e9);
  EXPECT_NEAR(sum.Value(), 1000.0 * Rho(loss, 1e9), 1e-6);
}

TEST(ApplyLoss, KeepsTheHessianPositiveForOutliers) {
  const RobustLoss loss = RobustLoss(BundleLoss::kCauchy, 2.0).Bent(true);
  for (const double angle_rad : {1e-4, 1e-3, 5e-3, 0.1, 2.0}) {
    const Eigen::Vector3d b(std::sin(angle_rad), 0.0, std::cos(angle_rad));
    BearingTerm term = LineariseBearing(Eigen::Vector3d::Zero(), {0, 0, 5}, b);
    const double weight = ApplyLoss(loss, 1e6, term);
    const Eigen::Matrix3d M = PointHessian(term, weight);
    EXPECT_GT(M(0, 0), 0.0) << angle_rad;
    EXPECT_GT(M(1, 1), 0.0) << angle_rad;
  }
}

}  // namespace
}  // namespace orbweave
