// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/ceres_adjuster.h"

#include <gtest/gtest.h>

#include "tests/core/bundle/bundle_world.h"

namespace orbweave {
namespace {

double LargestPointError(const BundleProblem& a, const BundleProblem& b) {
  double largest = 0.0;
  for (size_t i = 0; i < a.points_in_world.size(); ++i) {
    largest = std::max(largest, (a.points_in_world[i] - b.points_in_world[i]).norm());
  }
  return largest;
}

TEST(CeresAdjuster, FindsTheTruthBetweenTwoFixedPoses) {
  BundleWorld world = MakeBundleWorld({.sigma_rad = 1e-12});
  world.start.pose_is_fixed.assign(world.start.cams_from_world.size(), 0);
  for (const size_t i : {size_t{0}, size_t{5}}) {
    world.start.cams_from_world[i] = world.truth.cams_from_world[i];
    world.start.pose_is_fixed[i] = 1;
  }
  for (auto& seen : world.start.observations) seen.sigma_rad = 1e-3;
  const auto report = AdjustBundleWithCeres(
      world.start,
      {.loss = BundleLoss::kLeastSquares, .max_iterations = 100, .function_tolerance = 1e-16},
      {});
  ASSERT_TRUE(report.ok()) << report.status();
  EXPECT_LT(report->final_cost, 1e-12);
  EXPECT_LT(LargestPointError(world.start, world.truth), 1e-5);
}

TEST(CeresAdjuster, HoldsTheFirstPoseAndTheFarthestDistanceOfAFreeNetwork) {
  BundleProblem problem = MakeBundleWorld({}).start;
  const BundleProblem before = problem;
  const auto report = AdjustBundleWithCeres(problem, {}, {});
  ASSERT_TRUE(report.ok()) << report.status();
  EXPECT_LT(report->final_cost, 0.1 * report->initial_cost);
  EXPECT_EQ(problem.cams_from_world[0].rotation.coeffs(),
            before.cams_from_world[0].rotation.coeffs());
  EXPECT_EQ(problem.cams_from_world[0].translation, before.cams_from_world[0].translation);
  const auto distance = [](const BundleProblem& p) {
    return (p.cams_from_world.back().Centre() - p.cams_from_world.front().Centre()).norm();
  };
  EXPECT_NEAR(distance(problem), distance(before), 1e-9);
}

}  // namespace
}  // namespace orbweave
