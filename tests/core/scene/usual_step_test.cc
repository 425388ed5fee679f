// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/usual_step.h"

#include <gtest/gtest.h>

#include <vector>

namespace orbweave {
namespace {

double StepOf(const std::vector<double>& metres_east) {
  std::vector<PosePrior> priors;
  for (const double east : metres_east)
    priors.push_back({.position_in_enu = Eigen::Vector3d(east, 0.0, 3.0 * east)});
  std::vector<const PosePrior*> sequence;
  for (const PosePrior& prior : priors) sequence.push_back(&prior);
  return UsualStep(sequence);
}

TEST(UsualStep, IsTheMedianOnTheGround) { EXPECT_DOUBLE_EQ(StepOf({0, 8, 15, 24, 100}), 8.0); }

TEST(UsualStep, LeavesStandingOut) {
  EXPECT_DOUBLE_EQ(StepOf({0, 0.1, 0.2, 0.1, 0.3, 0.1, 0.2, 8.2, 16.2}), 8.0);
}

TEST(UsualStep, IsNothingOfNothing) {
  EXPECT_EQ(StepOf({}), 0.0);
  EXPECT_EQ(StepOf({5.0}), 0.0);
  PosePrior unknown;
  EXPECT_EQ(UsualStep(std::vector<const PosePrior*>{&unknown, &unknown}), 0.0);
}

TEST(SigmaBetween, AddsSquares) {
  PosePrior a;
  PosePrior b;
  a.horizontal_sigma_m = 3.0;
  b.horizontal_sigma_m = 4.0;
  EXPECT_DOUBLE_EQ(SigmaBetween(a, b), 5.0);
}

}  // namespace
}  // namespace orbweave
