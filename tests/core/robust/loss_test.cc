// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/robust/loss.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(CauchyLoss, IsQuadraticForSmallResiduals) {
  const CauchyLoss loss(2.0);
  EXPECT_NEAR(loss.Cost(1e-6) / 1e-6, 1.0, 1e-6);
  EXPECT_EQ(loss.Cost(0.0), 0.0);
  EXPECT_EQ(loss.Weight(0.0), 1.0);
}

TEST(CauchyLoss, WeightIsTheDerivativeOfTheCost) {
  const CauchyLoss loss(0.7);
  for (const double squared : {0.01, 0.3, 2.0, 50.0}) {
    const double h = 1e-6 * squared;
    EXPECT_NEAR(
        (loss.Cost(squared + h) - loss.Cost(squared - h)) / (2.0 * h), loss.Weight(squared), 1e-7);
  }
}

TEST(CauchyLoss, BoundsTheInfluenceOfOutliers) {
  const CauchyLoss loss(1.0);
  EXPECT_LT(loss.Weight(1e6) * 1e3, loss.Weight(1.0) * 1.0);  // influence: weight times residual
}

TEST(GemanMcClureLoss, WeightIsTheDerivativeOfTheCost) {
  const GemanMcClureLoss loss(3.0);
  EXPECT_EQ(loss.Cost(0.0), 0.0);
  EXPECT_EQ(loss.Weight(0.0), 1.0);
  for (const double squared : {0.01, 0.3, 2.0, 50.0}) {
    const double h = 1e-6 * squared;
    EXPECT_NEAR(
        (loss.Cost(squared + h) - loss.Cost(squared - h)) / (2.0 * h), loss.Weight(squared), 1e-7);
  }
}

TEST(GemanMcClureLoss, CostsNoMoreThanItsScaleSquared) {
  EXPECT_NEAR(GemanMcClureLoss(3.0).Cost(1e12), 9.0, 1e-6);
}

}  // namespace
}  // namespace orbweave
