// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/gauge.h"

#include <gtest/gtest.h>

#include "core/bundle/bearing_error.h"
#include "tests/core/bundle/bundle_world.h"

namespace orbweave {
namespace {

TEST(ChooseGauge, HoldsTheFirstObservingPoseAndTheFarthestDistance) {
  BundleProblem problem = MakeBundleWorld({}).start;
  std::erase_if(problem.observations, [](const BundleObservation& seen) { return seen.pose == 0; });
  const Gauge gauge = ChooseGauge(problem);
  EXPECT_EQ(gauge.anchor, 1U);
  EXPECT_EQ(gauge.farthest, 7U);
  EXPECT_EQ(gauge.pose_is_held, (std::vector<uint8_t>{0, 1, 0, 0, 0, 0, 0, 0}));
}

TEST(ChooseGauge, HoldsTheDistanceFromTheOnlyFixedPose) {
  BundleProblem problem = MakeBundleWorld({}).start;
  problem.pose_is_fixed = {0, 0, 0, 0, 0, 0, 1, 0};
  const Gauge gauge = ChooseGauge(problem);
  EXPECT_EQ(gauge.anchor, 6U);
  EXPECT_EQ(gauge.farthest, 0U);
  EXPECT_EQ(gauge.pose_is_held, problem.pose_is_fixed);
}

TEST(ChooseGauge, LeavesItToFixedPosesPointsAndPriors) {
  const BundleProblem free = MakeBundleWorld({}).start;
  BundleProblem two_poses = free;
  two_poses.pose_is_fixed = {1, 1, 0, 0, 0, 0, 0, 0};
  BundleProblem points = free;
  points.point_is_fixed.assign(points.points_in_world.size(), 1);
  BundleProblem priors = free;
  priors.position_priors.push_back({});
  for (const BundleProblem& problem : {two_poses, points, priors}) {
    EXPECT_FALSE(ChooseGauge(problem).anchor.has_value());
    EXPECT_FALSE(ChooseGauge(problem).farthest.has_value());
  }
}

TEST(RestoreScale, ChangesNoBearing) {
  BundleProblem problem = MakeBundleWorld({}).start;
  const Gauge gauge = ChooseGauge(problem);
  const BundleProblem before = problem;
  RestoreScale(gauge, 100.0, problem);
  EXPECT_NEAR(HeldDistance(gauge, problem), 100.0, 1e-12);
  for (const BundleObservation& seen : problem.observations) {
    const auto error = [&](const BundleProblem& p) {
      return BearingError(
          p.cams_from_world[seen.pose], p.points_in_world[seen.point], seen.bearing);
    };
    EXPECT_NEAR(error(problem), error(before), 1e-12);
  }
}

}  // namespace
}  // namespace orbweave
