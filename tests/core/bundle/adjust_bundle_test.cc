// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/adjust_bundle.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/bundle/bearing_error.h"
#include "core/bundle/bundle_options.h"
#include "core/bundle/bundle_problem.h"
#include "core/bundle/bundle_report.h"
#include "core/bundle/ceres_adjuster.h"
#include "tests/core/bundle/bundle_world.h"

namespace orbweave {
namespace {

const BundleOptions kToTheEnd{.max_iterations = 200, .function_tolerance = 1e-15};

BundleOptions ToTheEnd(BundleLoss loss) {
  BundleOptions options = kToTheEnd;
  options.loss = loss;
  return options;
}

BundleReport Adjust(BundleProblem& problem, const BundleOptions& options, int num_threads = 1) {
  const absl::StatusOr<BundleReport> report =
      AdjustBundle(problem, options, {.num_threads = num_threads});
  EXPECT_TRUE(report.ok()) << report.status();
  return report.value_or(BundleReport{});
}

template <typename Derived>
bool SameBits(const Eigen::MatrixBase<Derived>& a, const Eigen::MatrixBase<Derived>& b) {
  return std::memcmp(a.derived().data(),
                     b.derived().data(),
                     sizeof(double) * static_cast<size_t>(a.size())) == 0;
}

bool SamePose(const Rigid3& a, const Rigid3& b) {
  return SameBits(a.rotation.coeffs(), b.rotation.coeffs()) &&
         SameBits(a.translation, b.translation);
}

bool IsFinite(const BundleProblem& problem) {
  for (const Rigid3& pose : problem.cams_from_world) {
    if (!pose.rotation.coeffs().allFinite() || !pose.translation.allFinite()) return false;
  }
  for (const Eigen::Vector3d& point : problem.points_in_world) {
    if (!point.allFinite()) return false;
  }
  return true;
}

double LargestPointError(const BundleProblem& a, const BundleProblem& b) {
  double largest = 0.0;
  for (size_t i = 0; i < a.points_in_world.size(); ++i) {
    largest = std::max(largest, (a.points_in_world[i] - b.points_in_world[i]).norm());
  }
  return largest;
}

void FixTrueEnds(BundleWorld& world) {
  BundleProblem& start = world.start;
  start.pose_is_fixed.assign(start.cams_from_world.size(), 0);
  for (const size_t i : {size_t{0}, start.cams_from_world.size() - 1}) {
    start.cams_from_world[i] = world.truth.cams_from_world[i];
    start.pose_is_fixed[i] = 1;
  }
}

void AddPriors(BundleWorld& world, const Eigen::Vector3d& bias, double noise_m) {
  Random random(99);
  BundleProblem& start = world.start;
  start.bias_sigma_m = {5.0, 5.0};
  for (uint32_t i = 0; i < start.cams_from_world.size(); ++i) {
    const Eigen::Vector3d offset = i % 2 == 0 ? bias : -bias;
    start.position_priors.push_back({.pose = i,
                                     .position_in_world = world.truth.cams_from_world[i].Centre() +
                                                          offset + noise_m * RandomVector(random),
                                     .sigma_m = Eigen::Vector3d(0.5, 0.5, 1.0),
                                     .bias_group = i % 2});
  }
}

TEST(AdjustBundle, FindsTheTruthFromExactBearings) {
  BundleWorld world = MakeBundleWorld({.sigma_rad = 1e-13});
  for (BundleObservation& seen : world.start.observations) seen.sigma_rad = 1e-3;
  FixTrueEnds(world);
  const BundleReport report = Adjust(world.start, ToTheEnd(BundleLoss::kLeastSquares));
  EXPECT_TRUE(report.converged);
  EXPECT_LT(report.final_cost, 1e-15);
  EXPECT_LT(LargestPointError(world.start, world.truth), 1e-8);
}

TEST(AdjustBundle, ConvergesInAFewSteps) {
  BundleProblem problem = MakeBundleWorld({.num_poses = 20, .num_points = 1000}).start;
  EXPECT_LE(Adjust(problem, {.loss = BundleLoss::kLeastSquares}).iterations, 6);
}

TEST(AdjustBundle, ReachesTheCostOfCeres) {
  for (const BundleLoss loss :
       {BundleLoss::kLeastSquares, BundleLoss::kCauchy, BundleLoss::kHuber}) {
    BundleWorld world =
        MakeBundleWorld({.outlier_share = loss == BundleLoss::kLeastSquares ? 0.0 : 0.02});
    BundleProblem ours = world.start;
    BundleProblem theirs = world.start;
    BundleOptions options = ToTheEnd(loss);
    options.max_iterations = 1000;
    const BundleReport report = Adjust(ours, options);
    const auto oracle = AdjustBundleWithCeres(theirs, options, {});
    ASSERT_TRUE(oracle.ok());
    EXPECT_NEAR(report.initial_cost, oracle->initial_cost, 1e-12 * oracle->initial_cost);
    EXPECT_NEAR(report.final_cost, oracle->final_cost, 1e-8 * oracle->final_cost)
        << internal::ValueToText(loss) << " after " << report.iterations << ", Ceres "
        << oracle->iterations;
  }
}

TEST(AdjustBundle, ReachesTheCostOfCeresWithPriorsAndFixedBlocks) {
  BundleWorld world = MakeBundleWorld({.num_poses = 10});
  AddPriors(world, {0.4, -0.3, 0.2}, 0.3);
  world.start.pose_is_fixed.assign(10, 0);
  world.start.pose_is_fixed[4] = 1;
  world.start.point_is_fixed.assign(world.start.points_in_world.size(), 0);
  for (size_t i = 0; i < 50; ++i) world.start.point_is_fixed[i] = 1;
  Random random(3);
  for (uint32_t i = 5; i < 10; ++i) {
    world.start.direction_priors.push_back({.pose = i,
                                            .direction_in_world = RandomVector(random).normalized(),
                                            .direction_in_cam = RandomVector(random).normalized(),
                                            .sigma_rad = 0.1});
  }
  BundleProblem ours = world.start;
  BundleProblem theirs = world.start;
  const BundleReport report = Adjust(ours, kToTheEnd);
  const auto oracle = AdjustBundleWithCeres(theirs, kToTheEnd, {});
  ASSERT_TRUE(oracle.ok());
  EXPECT_NEAR(report.final_cost, oracle->final_cost, 1e-8 * oracle->final_cost);
  ASSERT_EQ(report.biases_m.size(), 2U);
  EXPECT_LT((report.biases_m[0] - oracle->biases_m[0]).norm(), 1e-4);
}

TEST(AdjustBundle, LeavesFixedBlocksUntouched) {
  BundleWorld world = MakeBundleWorld({});
  FixTrueEnds(world);
  world.start.point_is_fixed.assign(world.start.points_in_world.size(), 0);
  world.start.point_is_fixed[7] = 1;
  BundleProblem after = world.start;
  Adjust(after, {});
  EXPECT_TRUE(SamePose(after.cams_from_world.front(), world.start.cams_from_world.front()));
  EXPECT_TRUE(SamePose(after.cams_from_world.back(), world.start.cams_from_world.back()));
  EXPECT_TRUE(SameBits(after.points_in_world[7], world.start.points_in_world[7]));
  EXPECT_FALSE(SamePose(after.cams_from_world[1], world.start.cams_from_world[1]));
  EXPECT_FALSE(SameBits(after.points_in_world[8], world.start.points_in_world[8]));
}

TEST(AdjustBundle, GivesTheSameBytesForAnyNumberOfThreads) {
  BundleWorld world = MakeBundleWorld({.num_poses = 30, .num_points = 3000, .outlier_share = 0.02});
  AddPriors(world, {0.4, -0.3, 0.2}, 0.3);
  BundleProblem one = world.start;
  BundleProblem three = world.start;
  const BundleReport report_of_one = Adjust(one, {}, 1);
  const BundleReport report_of_three = Adjust(three, {}, 3);
  EXPECT_EQ(report_of_one.final_cost, report_of_three.final_cost);
  for (size_t i = 0; i < one.cams_from_world.size(); ++i) {
    EXPECT_TRUE(SamePose(one.cams_from_world[i], three.cams_from_world[i]));
  }
  for (size_t i = 0; i < one.points_in_world.size(); ++i) {
    EXPECT_TRUE(SameBits(one.points_in_world[i], three.points_in_world[i]));
  }
}

TEST(AdjustBundle, TurnsWithTheWorld) {
  const BundleProblem before = MakeBundleWorld({.outlier_share = 0.01}).start;
  Random random(5);
  const Eigen::Quaterniond turn = RotationFromVector(RandomVector(random));
  BundleProblem plain = before;
  BundleProblem turned = before;
  for (Rigid3& pose : turned.cams_from_world) pose.rotation = pose.rotation * turn.conjugate();
  for (Eigen::Vector3d& point : turned.points_in_world) point = turn * point;
  const BundleReport plain_report = Adjust(plain, {});
  const BundleReport turned_report = Adjust(turned, {});
  // The steps turn too, not only the optimum.
  EXPECT_EQ(plain_report.iterations, turned_report.iterations);
  EXPECT_NEAR(plain_report.final_cost, turned_report.final_cost, 1e-9 * plain_report.final_cost);
  for (size_t i = 0; i < plain.points_in_world.size(); ++i) {
    EXPECT_LT((turn * plain.points_in_world[i] - turned.points_in_world[i]).norm(), 1e-6);
  }
}

TEST(AdjustBundle, PosesAbsorbThePanoramasOwnRotations) {
  const BundleProblem before = MakeBundleWorld({.outlier_share = 0.01}).start;
  Random random(6);
  BundleProblem plain = before;
  BundleProblem turned = before;
  std::vector<Eigen::Quaterniond> turns;
  for (Rigid3& pose : turned.cams_from_world) {
    turns.push_back(RotationFromVector(RandomVector(random)));
    pose = Rigid3{turns.back(), Eigen::Vector3d::Zero()} * pose;
  }
  for (BundleObservation& seen : turned.observations)
    seen.bearing = turns[seen.pose] * seen.bearing;
  EXPECT_EQ(Adjust(plain, {}).iterations, Adjust(turned, {}).iterations);
  for (size_t i = 0; i < plain.points_in_world.size(); ++i) {
    EXPECT_LT((plain.points_in_world[i] - turned.points_in_world[i]).norm(), 1e-6);
  }
}

TEST(AdjustBundle, HoldsTheFirstPoseAndTheFarthestDistanceOfAFreeNetwork) {
  BundleProblem problem = MakeBundleWorld({}).start;
  const BundleProblem before = problem;
  Adjust(problem, {});
  EXPECT_TRUE(SamePose(problem.cams_from_world[0], before.cams_from_world[0]));
  const auto distance = [](const BundleProblem& p) {
    return (p.cams_from_world.back().Centre() - p.cams_from_world.front().Centre()).norm();
  };
  EXPECT_NEAR(distance(problem), distance(before), 1e-12);
}

TEST(AdjustBundle, PutsTheModelWhereThePriorsAre) {
  BundleWorld world = MakeBundleWorld({.num_poses = 20, .num_points = 800, .sigma_rad = 3e-4});
  const Eigen::Vector3d shift(3.0, -2.0, 1.0);
  for (uint32_t i = 0; i < 20; ++i) {
    const Eigen::Vector3d blunder = i == 3 ? Eigen::Vector3d(40, 0, 0) : Eigen::Vector3d::Zero();
    world.start.position_priors.push_back(
        {.pose = i,
         .position_in_world = world.truth.cams_from_world[i].Centre() + shift + blunder});
  }
  Adjust(world.start, kToTheEnd);
  for (uint32_t i = 0; i < 20; ++i) {
    const Eigen::Vector3d expected = world.truth.cams_from_world[i].Centre() + shift;
    EXPECT_LT((world.start.cams_from_world[i].Centre() - expected).norm(), 0.05);
  }
}

TEST(AdjustBundle, SurvivesPointsSeenOnceAndPosesWithoutObservations) {
  BundleProblem problem = MakeBundleWorld({}).start;
  const auto lonely_pose = static_cast<uint32_t>(problem.cams_from_world.size());
  problem.cams_from_world.push_back(
      Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {900, 0, 0}));
  problem.points_in_world.emplace_back(5, 5, 5);  // seen once
  problem.points_in_world.emplace_back(6, 6, 6);  // never seen
  const auto once = static_cast<uint32_t>(problem.points_in_world.size() - 2);
  problem.observations.push_back(
      {.pose = 2, .point = once, .bearing = Eigen::Vector3d(1, 2, 2) / 3.0});
  const BundleProblem before = problem;
  EXPECT_TRUE(Adjust(problem, {}).converged);
  EXPECT_TRUE(IsFinite(problem));
  EXPECT_LT(
      BearingError(
          problem.cams_from_world[2], problem.points_in_world[once], {1.0 / 3, 2.0 / 3, 2.0 / 3}),
      1e-3);
  EXPECT_EQ(problem.points_in_world[once + 1], before.points_in_world[once + 1]);
  EXPECT_LT(
      (problem.cams_from_world[lonely_pose].Centre() - before.cams_from_world[lonely_pose].Centre())
          .norm(),
      1e-9);
}

TEST(AdjustBundle, SurvivesParallelRays) {
  BundleProblem problem = MakeBundleWorld({}).start;
  for (int i = 0; i < 20; ++i) {  // points at infinity with a start near by
    const auto point = static_cast<uint32_t>(problem.points_in_world.size());
    problem.points_in_world.emplace_back(3.0 * i, 20, 5);
    for (const uint32_t pose : {2U, 3U, 4U}) {
      const Eigen::Vector3d ray_in_cam =
          problem.cams_from_world[pose].rotation * Eigen::Vector3d(0.1 * i - 1.0, 1, 0.2);
      problem.observations.push_back(
          {.pose = pose, .point = point, .bearing = ray_in_cam.normalized()});
    }
  }
  const BundleReport report = Adjust(problem, {});
  EXPECT_TRUE(IsFinite(problem));
  EXPECT_LT(report.final_cost, 0.2 * report.initial_cost);
}

TEST(AdjustBundle, BringsBackAPointFromBehind) {
  BundleWorld world = MakeBundleWorld({.sigma_rad = 1e-4});
  FixTrueEnds(world);
  world.start.cams_from_world = world.truth.cams_from_world;
  world.start.points_in_world = world.truth.points_in_world;
  world.start.points_in_world[10].y() *= -1.0;  // the other side of the street
  Adjust(world.start, ToTheEnd(BundleLoss::kLeastSquares));
  EXPECT_LT((world.start.points_in_world[10] - world.truth.points_in_world[10]).norm(), 0.05);
}

TEST(AdjustBundle, AcceptsProblemsWithNothingToDo) {
  BundleProblem empty;
  EXPECT_TRUE(Adjust(empty, {}).converged);
  BundleProblem held = MakeBundleWorld({}).start;
  held.pose_is_fixed.assign(held.cams_from_world.size(), 1);
  held.point_is_fixed.assign(held.points_in_world.size(), 1);
  const BundleProblem before = held;
  const BundleReport report = Adjust(held, {});
  EXPECT_EQ(report.initial_cost, report.final_cost);
  EXPECT_TRUE(SamePose(held.cams_from_world[3], before.cams_from_world[3]));
}

TEST(AdjustBundle, NamesAnIndexOutOfRange) {
  BundleProblem problem = MakeBundleWorld({}).start;
  problem.observations[5].point = 100000;
  const absl::Status status = AdjustBundle(problem, {}, {}).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(status.message().find("point 100000"), std::string::npos);
}

TEST(AdjustBundle, StopsOnRequest) {
  std::stop_source source;
  source.request_stop();
  BundleProblem problem = MakeBundleWorld({}).start;
  for (const BundleSolver solver : {BundleSolver::kSchur, BundleSolver::kCeres}) {
    const absl::Status status =
        AdjustBundle(problem, {.solver = solver}, {.stop = source.get_token()}).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kCancelled);
  }
}

}  // namespace
}  // namespace orbweave
