// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/estimate_absolute_pose.h"

#include <gtest/gtest.h>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::MakeResectionWorld;
using testing::ResectionWorld;
using testing::RotationError;

constexpr double kSigmaRad = 1e-3;
constexpr double kMaxErrorRad = 4.7e-3;  // 4 px of a panorama 5376 px wide

std::optional<AbsolutePose> Estimate(const ResectionWorld& world, uint64_t seed = 1) {
  const auto pose =
      EstimateAbsolutePose(world.bearings, world.points_in_world, kMaxErrorRad, {}, {.seed = seed});
  EXPECT_TRUE(pose.ok()) << pose.status();
  return *pose;
}

TEST(EstimateAbsolutePose, IsExactOnCleanData) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const ResectionWorld world = MakeResectionWorld(seed, 50);
    const auto pose = Estimate(world);
    ASSERT_TRUE(pose.has_value());
    EXPECT_LT(RotationError(pose->cam_from_world.rotation, world.cam_from_world.rotation), 1e-8);
    EXPECT_LT((pose->cam_from_world.Centre() - world.cam_from_world.Centre()).norm(), 1e-7);
    EXPECT_EQ(pose->num_inliers, 50U);
  }
}

class EstimateAbsolutePoseWithOutliers : public ::testing::TestWithParam<double> {};

TEST_P(EstimateAbsolutePoseWithOutliers, IsRightForEverySeed) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const ResectionWorld world = MakeResectionWorld(seed, 300, GetParam(), kSigmaRad);
    const auto pose = Estimate(world);
    ASSERT_TRUE(pose.has_value());
    EXPECT_LT(RotationError(pose->cam_from_world.rotation, world.cam_from_world.rotation), 1e-3)
        << seed;
    EXPECT_LT((pose->cam_from_world.Centre() - world.cam_from_world.Centre()).norm(), 2e-2) << seed;
    const auto num_right = static_cast<double>(300 - world.num_outliers);
    EXPECT_GT(pose->num_inliers, 0.98 * num_right) << seed;
    EXPECT_LT(pose->num_inliers, num_right + 6) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Shares,
                         EstimateAbsolutePoseWithOutliers,
                         ::testing::Values(0.3, 0.5, 0.7));

TEST(EstimateAbsolutePose, IsDeterministic) {
  const ResectionWorld world = MakeResectionWorld(3, 200, 0.5, kSigmaRad);
  const auto once = Estimate(world);
  const auto again = Estimate(world);
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->cam_from_world.translation, again->cam_from_world.translation);
  EXPECT_EQ(once->is_inlier, again->is_inlier);
}

TEST(EstimateAbsolutePose, WorksFarFromTheOrigin) {
  ResectionWorld world = MakeResectionWorld(4, 200, 0.3, kSigmaRad);
  const Vector3d shift(4e5, 5e6, 300);
  for (Vector3d& P : world.points_in_world) P += shift;
  const auto pose = Estimate(world);
  ASSERT_TRUE(pose.has_value());
  EXPECT_LT((pose->cam_from_world.Centre() - shift - world.cam_from_world.Centre()).norm(), 2e-2);
}

TEST(EstimateAbsolutePose, HasNoAnswerWithoutSupport) {
  EXPECT_FALSE(Estimate(MakeResectionWorld(1, 40, 1.0)).has_value());
  EXPECT_FALSE(Estimate(MakeResectionWorld(1, 5)).has_value());
  EXPECT_FALSE(Estimate(MakeResectionWorld(1, 2)).has_value());
  EXPECT_FALSE(Estimate({}).has_value());
}

TEST(EstimateAbsolutePose, HasNoAnswerForCollinearPoints) {
  ResectionWorld world = MakeResectionWorld(2, 30);
  for (size_t i = 0; i < world.points_in_world.size(); ++i) {
    world.points_in_world[i] = Vector3d(1, 2, 3) * static_cast<double>(i);
    world.bearings[i] = testing::BearingOf(world.cam_from_world, world.points_in_world[i]);
  }
  EXPECT_FALSE(Estimate(world).has_value());
}

TEST(EstimateAbsolutePose, HasNoAnswerForIdenticalBearings) {
  ResectionWorld world = MakeResectionWorld(2, 30);
  for (Vector3d& bearing : world.bearings) bearing = Vector3d::UnitZ();
  const auto pose = Estimate(world);
  if (pose) {  // points far off may look alike, but never with a broken number
    EXPECT_TRUE(pose->cam_from_world.translation.allFinite());
  }
}

TEST(EstimateAbsolutePose, StopsOnRequest) {
  std::stop_source source;
  source.request_stop();
  const ResectionWorld world = MakeResectionWorld(1, 50);
  const auto pose = EstimateAbsolutePose(world.bearings,
                                         world.points_in_world,
                                         kMaxErrorRad,
                                         {},
                                         {.stop = source.get_token(), .seed = 1});
  EXPECT_EQ(pose.status().code(), absl::StatusCode::kCancelled);
}

TEST(RefineAbsolutePose, PullsADisturbedPoseBack) {
  const ResectionWorld world = MakeResectionWorld(5, 100);
  Rigid3 start = world.cam_from_world;
  start.rotation = RotationFromVector({0.02, -0.03, 0.01}) * start.rotation;
  start.translation += Vector3d(0.1, -0.2, 0.1);
  const Rigid3 refined =
      RefineAbsolutePose(start, world.bearings, world.points_in_world, {}, kMaxErrorRad);
  EXPECT_LT(RotationError(refined.rotation, world.cam_from_world.rotation), 1e-6);
  EXPECT_LT((refined.Centre() - world.cam_from_world.Centre()).norm(), 1e-5);
}

TEST(RefineAbsolutePose, UsesOnlyTheInliers) {
  const ResectionWorld world = MakeResectionWorld(6, 100, 0.3);
  std::vector<uint8_t> is_inlier(100, 1);
  std::fill_n(is_inlier.begin(), world.num_outliers, 0);
  Rigid3 start = world.cam_from_world;
  start.translation += Vector3d(0.05, -0.05, 0.05);
  const Rigid3 refined =
      RefineAbsolutePose(start, world.bearings, world.points_in_world, is_inlier, kMaxErrorRad);
  EXPECT_LT((refined.Centre() - world.cam_from_world.Centre()).norm(), 1e-5);
}

}  // namespace
}  // namespace orbweave
