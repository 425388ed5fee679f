// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/depth_sigma.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orbweave {
namespace {

CostMinimum OfParabola(float least, float curvature, float at, float step) {
  const auto cost = [&](float x) { return least + 0.5F * curvature * (x - at) * (x - at); };
  return FindMinimum(cost(0.0F), cost(step), cost(-step), step, 0.5F);
}

TEST(FindMinimum, FindsThatOfAParabola) {
  const CostMinimum minimum = OfParabola(0.1F, 400.0F, 0.004F, 0.01F);
  EXPECT_NEAR(minimum.offset, 0.004F, 1e-5F);
  EXPECT_NEAR(minimum.cost, 0.1F, 1e-4F);
}

TEST(FindMinimum, IsSurerTheSharperAndTheDeeperTheMinimumIs) {
  const float sigma = OfParabola(0.1F, 400.0F, 0.0F, 0.01F).sigma;
  EXPECT_LT(OfParabola(0.1F, 1600.0F, 0.0F, 0.01F).sigma, sigma);
  EXPECT_LT(OfParabola(0.02F, 400.0F, 0.0F, 0.01F).sigma, sigma);
}

TEST(FindMinimum, DoesNotDependOnTheStepBeyondTheFloor) {
  const float sigma = OfParabola(0.4F, 100.0F, 0.0F, 0.01F).sigma;
  EXPECT_NEAR(OfParabola(0.4F, 100.0F, 0.0F, 0.02F).sigma, sigma, 0.1F * sigma);
}

TEST(FindMinimum, KnowsNothingWhereThereIsNoMinimum) {
  EXPECT_TRUE(std::isinf(FindMinimum(0.3F, 0.3F, 0.3F, 0.01F, 0.5F).sigma));
  const CostMinimum falling = FindMinimum(0.3F, 0.2F, 0.4F, 0.01F, 0.5F);
  EXPECT_TRUE(std::isinf(falling.sigma));
  EXPECT_EQ(falling.offset, 0.01F);  // goes on where it is cheaper
  EXPECT_EQ(falling.cost, 0.2F);
}

}  // namespace
}  // namespace orbweave
