// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/bearing_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using testing::MakeResectionWorld;
using testing::ResectionWorld;

constexpr double kMaxErrorRad = 0.05;

Rigid3 FromOrigin(const BearingPoints& data, const Rigid3& cam_from_world) {
  return cam_from_world * Rigid3{Eigen::Quaterniond::Identity(), data.origin};
}

TEST(ArrangePoints, KeepsEveryCorrespondenceOnceUnderItsIndex) {
  const ResectionWorld world = MakeResectionWorld(1, 50);
  const BearingPoints data = ArrangePoints(world.bearings, world.points_in_world, 1);
  std::vector<uint32_t> order = data.order;
  for (size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(data.Bearing(i), world.bearings[order[i]]);
    EXPECT_LT((data.Point(i) + data.origin - world.points_in_world[order[i]]).norm(), 1e-12);
  }
  std::sort(order.begin(), order.end());
  EXPECT_TRUE(std::unique(order.begin(), order.end()) == order.end());
}

TEST(ScorePose, AgreesWithTheAngleOfEachCorrespondence) {
  const ResectionWorld world = MakeResectionWorld(2, 333, 0.5, 0.02);
  const BearingPoints data = ArrangePoints(world.bearings, world.points_in_world, 1);
  const Rigid3 pose = FromOrigin(data, world.cam_from_world);
  const auto score = ScorePose(data, pose, kMaxErrorRad, EarlyRejection(333));
  ASSERT_TRUE(score.has_value());
  double cost = 0.0;
  std::vector<uint32_t> inliers;
  for (uint32_t i = 0; i < 333; ++i) {
    const double angle = AngleBetween(data.Bearing(i), pose * data.Point(i));
    cost += std::pow(2.0 * std::sin(0.5 * std::min(angle, kMaxErrorRad)), 2);
    if (angle < kMaxErrorRad) inliers.push_back(i);
  }
  EXPECT_NEAR(score->cost, cost, 1e-12 * 333);
  EXPECT_EQ(score->num_inliers, inliers.size());
  EXPECT_EQ(PoseInliers(data, pose, kMaxErrorRad), inliers);
}

TEST(PoseInliers, LeaveOutTheAntipodes) {
  ResectionWorld world = MakeResectionWorld(3, 20);
  for (Eigen::Vector3d& bearing : world.bearings) bearing *= -1.0;
  const BearingPoints data = ArrangePoints(world.bearings, world.points_in_world, 1);
  EXPECT_TRUE(PoseInliers(data, FromOrigin(data, world.cam_from_world), kMaxErrorRad).empty());
}

TEST(ScorePose, StopsAtTheGate) {
  const ResectionWorld world = MakeResectionWorld(4, 300, 0.5);
  const BearingPoints data = ArrangePoints(world.bearings, world.points_in_world, 1);
  EarlyRejection gate(300);
  gate.Raise(0.0, 300);
  EXPECT_FALSE(
      ScorePose(data, FromOrigin(data, world.cam_from_world), kMaxErrorRad, gate).has_value());
}

}  // namespace
}  // namespace orbweave
