// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/robust/levenberg_marquardt.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orbweave {
namespace {

using Eigen::Vector2d;

Vector2d Add(const Vector2d& x, const Vector2d& delta) { return x + delta; }

/// Rosenbrock's valley as residuals 10 (y - x^2) and 1 - x.
Linearisation<2> Rosenbrock(const Vector2d& x) {
  Linearisation<2> sum;
  const double r0 = 10.0 * (x.y() - x.x() * x.x());
  const double r1 = 1.0 - x.x();
  sum.Add(r0, Vector2d(-20.0 * x.x(), 10.0), 1.0);
  sum.Add(r1, Vector2d(-1.0, 0.0), 1.0);
  sum.cost = r0 * r0 + r1 * r1;
  return sum;
}

TEST(MinimiseLevenbergMarquardt, FindsTheEndOfRosenbrocksValley) {
  const Vector2d x = MinimiseLevenbergMarquardt<2>(
      Vector2d(-1.2, 1.0), Rosenbrock, Add, {.max_steps = 100, .min_relative_decrease = 1e-12});
  EXPECT_NEAR(x.x(), 1.0, 1e-6);
  EXPECT_NEAR(x.y(), 1.0, 1e-6);
}

TEST(MinimiseLevenbergMarquardt, NeverReturnsAWorseState) {
  for (int max_steps = 0; max_steps < 20; ++max_steps) {
    const Vector2d start(-1.2, 1.0);
    const Vector2d x =
        MinimiseLevenbergMarquardt<2>(start, Rosenbrock, Add, {.max_steps = max_steps});
    EXPECT_LE(Rosenbrock(x).cost, Rosenbrock(start).cost);
  }
}

TEST(MinimiseLevenbergMarquardt, KeepsTheStartWithoutData) {
  const auto nothing = [](const Vector2d&) { return Linearisation<2>{}; };
  EXPECT_EQ(MinimiseLevenbergMarquardt<2>(Vector2d(3.0, 4.0), nothing, Add), Vector2d(3.0, 4.0));
}

TEST(MinimiseLevenbergMarquardt, LeavesUndeterminedDirectionsFinite) {
  const auto first_only = [](const Vector2d& x) {
    Linearisation<2> sum;
    sum.Add(x.x() - 5.0, Vector2d(1.0, 0.0), 1.0);
    sum.cost = (x.x() - 5.0) * (x.x() - 5.0);
    return sum;
  };
  const Vector2d x = MinimiseLevenbergMarquardt<2>(Vector2d(0.0, 2.0), first_only, Add);
  EXPECT_NEAR(x.x(), 5.0, 1e-3);
  EXPECT_TRUE(std::isfinite(x.y()));
}

}  // namespace
}  // namespace orbweave
