// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/levenberg_marquardt.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

const BundleOptions kOptions{
    .max_iterations = 10, .function_tolerance = 1e-6, .initial_lambda = 1e-3};

TEST(LevenbergMarquardt, TrustsTheModelMoreAfterAStepThatKeptItsPromise) {
  const LevenbergMarquardt start = StartLevenbergMarquardt(100.0, kOptions);
  const LevenbergMarquardt next = AfterTrial(start, 60.0, 40.0, kOptions);
  EXPECT_TRUE(next.accepted);
  EXPECT_EQ(next.cost, 60.0);
  EXPECT_EQ(next.iterations, 1);
  EXPECT_DOUBLE_EQ(next.control.lambda, 1e-3 / 3.0);
  EXPECT_FALSE(next.control.is_bent);
  EXPECT_TRUE(WantsStep(next, kOptions));
}

TEST(LevenbergMarquardt, DampsMoreAndMoreWhileStepsFail) {
  LevenbergMarquardt path = StartLevenbergMarquardt(100.0, kOptions);
  path = AfterTrial(path, 101.0, 40.0, kOptions);
  EXPECT_DOUBLE_EQ(path.control.lambda, 2e-3);
  path = AfterFailure(path);
  EXPECT_DOUBLE_EQ(path.control.lambda, 8e-3);
  EXPECT_FALSE(path.accepted);
  EXPECT_EQ(path.cost, 100.0);
  EXPECT_EQ(path.iterations, 2);
  path = AfterTrial(path, 90.0, 40.0, kOptions);
  EXPECT_TRUE(path.accepted);
  EXPECT_DOUBLE_EQ(path.growth, 2.0);
}

TEST(LevenbergMarquardt, BendsTheLossNearTheEnd) {
  const LevenbergMarquardt start = StartLevenbergMarquardt(100.0, kOptions);
  const LevenbergMarquardt near = AfterTrial(start, 99.5, 0.5, kOptions);
  EXPECT_TRUE(near.control.is_bent);
  EXPECT_FALSE(AfterTrial(near, 99.6, 0.5, kOptions).control.is_bent);
}

TEST(LevenbergMarquardt, EndsWhenTheCostHardlyFalls) {
  const LevenbergMarquardt start = StartLevenbergMarquardt(100.0, kOptions);
  const LevenbergMarquardt end = AfterTrial(start, 100.0 - 1e-5, 1e-5, kOptions);
  EXPECT_TRUE(end.converged);
  EXPECT_FALSE(WantsStep(end, kOptions));
  // Also when nothing is left to gain; not when a promised gain did not come.
  EXPECT_TRUE(AfterTrial(start, 100.0, 1e-12, kOptions).converged);
  EXPECT_FALSE(AfterTrial(start, 100.0, 1.0, kOptions).converged);
}

TEST(LevenbergMarquardt, EndsAfterTheLastIterationOrWhenDampedToAHalt) {
  LevenbergMarquardt path = StartLevenbergMarquardt(100.0, kOptions);
  while (WantsStep(path, kOptions)) path = AfterFailure(path);
  EXPECT_FALSE(path.converged);
  EXPECT_LE(path.iterations, kOptions.max_iterations);
  EXPECT_GT(path.control.lambda, 1e12);
  BundleOptions one_step = kOptions;
  one_step.max_iterations = 1;
  EXPECT_FALSE(
      WantsStep(AfterTrial(StartLevenbergMarquardt(1.0, one_step), 0.5, 0.5, one_step), one_step));
}

}  // namespace
}  // namespace orbweave
