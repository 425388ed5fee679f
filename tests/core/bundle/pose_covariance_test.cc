// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/pose_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "core/bundle/adjust_bundle.h"
#include "core/bundle/bearing_residual.h"
#include "tests/core/bundle/bundle_world.h"

namespace orbweave {
namespace {

const BundleOptions kLeastSquaresToTheEnd{
    .loss = BundleLoss::kLeastSquares, .max_iterations = 100, .function_tolerance = 1e-14};

constexpr uint32_t kNumPoses = 25;
constexpr double kTilt_rad = 0.02;

// Positions of all panoramas with normal errors of 0.3 m, 0.45 m upwards, and where down is.
void AddPriors(uint64_t seed, const BundleProblem& truth, BundleProblem& problem) {
  Random random(seed);
  const Eigen::Vector3d sigma_m(0.3, 0.3, 0.45);
  const Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();
  for (uint32_t i = 0; i < truth.cams_from_world.size(); ++i) {
    problem.position_priors.push_back(
        {.pose = i,
         .position_in_world =
             truth.cams_from_world[i].Centre() + sigma_m.cwiseProduct(RandomVector(random)),
         .sigma_m = sigma_m});
    const Eigen::Vector3d tilted = down + kTilt_rad * RandomVector(random);
    problem.direction_priors.push_back(
        {.pose = i,
         .direction_in_world = down,
         .direction_in_cam = truth.cams_from_world[i].rotation * tilted.normalized(),
         .sigma_rad = kTilt_rad});
  }
}

BundleWorld StreetWithPriors(uint64_t seed) {
  BundleWorld world =
      MakeBundleWorld({.num_poses = kNumPoses, .num_points = 400, .sigma_rad = 3e-3, .seed = seed});
  AddPriors(seed + 1000, world.truth, world.start);
  return world;
}

// J^T J of all bearings, dense: the poses, then the points.
Eigen::MatrixXd DenseInformation(const BundleProblem& problem) {
  const auto num_poses = static_cast<Eigen::Index>(problem.cams_from_world.size());
  const auto size = 6 * num_poses + 3 * static_cast<Eigen::Index>(problem.points_in_world.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, size);
  for (const BundleObservation& seen : problem.observations) {
    const Rigid3& pose = problem.cams_from_world[seen.pose];
    const BearingResidual residual = EvaluateBearingResidual(pose.rotation.toRotationMatrix(),
                                                             pose.Centre(),
                                                             problem.points_in_world[seen.point],
                                                             seen.bearing);
    Eigen::Matrix<double, 2, 9> J;
    J << residual.d_pose, residual.d_point;
    const Eigen::Matrix<double, 9, 9> JtJ = J.transpose() * J / (seen.sigma_rad * seen.sigma_rad);
    const Eigen::Index pose_at = 6 * seen.pose;
    const Eigen::Index point_at = 6 * num_poses + 3 * seen.point;
    H.block<6, 6>(pose_at, pose_at) += JtJ.topLeftCorner<6, 6>();
    H.block<6, 3>(pose_at, point_at) += JtJ.topRightCorner<6, 3>();
    H.block<3, 6>(point_at, pose_at) += JtJ.bottomLeftCorner<3, 6>();
    H.block<3, 3>(point_at, point_at) += JtJ.bottomRightCorner<3, 3>();
  }
  return H;
}

// Points that nobody sees are held, and the points are eliminated.
Eigen::MatrixXd PosePart(Eigen::MatrixXd H, Eigen::Index num_variables) {
  for (Eigen::Index i = num_variables; i < H.rows(); ++i) {
    if (H(i, i) == 0.0) H(i, i) = 1.0;
  }
  const Eigen::Index m = H.rows() - num_variables;
  return H.topLeftCorner(num_variables, num_variables) -
         H.topRightCorner(num_variables, m) *
             H.bottomRightCorner(m, m).llt().solve(H.bottomLeftCorner(m, num_variables));
}

TEST(PoseCovariance, IsTheDenseInverseWithPositions) {
  BundleProblem problem = StreetWithPriors(1).start;
  ASSERT_TRUE(AdjustBundle(problem, kLeastSquaresToTheEnd, {}).ok());
  const PoseCovariances covariances = EstimatePoseCovariances(problem, {}, 1);
  ASSERT_EQ(covariances.reason, "");
  EXPECT_FALSE(covariances.anchor.has_value());
  const Eigen::Index n = 6 * kNumPoses;
  Eigen::MatrixXd S = PosePart(DenseInformation(problem), n) / covariances.factors.bearings;
  for (const PositionPrior& prior : problem.position_priors) {
    S.diagonal().segment<3>(6 * prior.pose + 3) +=
        prior.sigma_m.cwiseAbs2().cwiseProduct(covariances.factors.positions).cwiseInverse();
  }
  for (const DirectionPrior& prior : problem.direction_priors) {
    const Rigid3& pose = problem.cams_from_world[prior.pose];
    const BearingResidual residual = EvaluateBearingResidual(pose.rotation.toRotationMatrix(),
                                                             Eigen::Vector3d::Zero(),
                                                             prior.direction_in_world,
                                                             prior.direction_in_cam);
    const Eigen::Matrix<double, 2, 3> J = residual.d_pose.leftCols<3>() / prior.sigma_rad;
    S.block<3, 3>(6 * prior.pose, 6 * prior.pose) += J.transpose() * J;
  }
  const Eigen::MatrixXd expected = S.llt().solve(Eigen::MatrixXd::Identity(n, n));
  for (Eigen::Index i = 0; i < kNumPoses; ++i) {
    const Block6 block = expected.block<6, 6>(6 * i, 6 * i);
    EXPECT_LT((*covariances.poses[static_cast<size_t>(i)] - block).norm(), 1e-8 * block.norm());
  }
}

TEST(PoseCovariance, IsTheDenseInverseWithAHeldPoseAndDistance) {
  BundleProblem problem = MakeBundleWorld({.num_poses = 8, .num_points = 100}).start;
  ASSERT_TRUE(AdjustBundle(problem, kLeastSquaresToTheEnd, {}).ok());
  const PoseCovariances covariances = EstimatePoseCovariances(problem, {}, 1);
  ASSERT_EQ(covariances.anchor, 0U);
  ASSERT_EQ(covariances.farthest, 7U);
  // The anchor's rows leave, then the held distance as a constraint that borders the system.
  const Eigen::Index n = 6 * 7;
  Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(n + 1, n + 1);
  bordered.topLeftCorner(n, n) = PosePart(DenseInformation(problem), 6 * 8).bottomRightCorner(n, n);
  bordered *= 1.0 / covariances.factors.bearings;
  const Eigen::Vector3d axis =
      (problem.cams_from_world[7].Centre() - problem.cams_from_world[0].Centre()).normalized();
  bordered.col(n).segment<3>(n - 3) = axis;
  bordered.row(n).segment<3>(n - 3) = axis.transpose();
  const Eigen::MatrixXd expected = bordered.fullPivLu().inverse();
  EXPECT_TRUE(covariances.poses[0]->isZero());
  for (Eigen::Index i = 0; i < 7; ++i) {
    const Block6 block = expected.block<6, 6>(6 * i, 6 * i);
    EXPECT_LT((*covariances.poses[static_cast<size_t>(i) + 1] - block).norm(), 1e-8 * block.norm());
  }
}

TEST(PoseCovariance, DoesNotNoticeHowThePanoramasAreTurned) {
  BundleProblem problem = StreetWithPriors(2).start;
  ASSERT_TRUE(AdjustBundle(problem, kLeastSquaresToTheEnd, {}).ok());
  const PoseCovariances before = EstimatePoseCovariances(problem, {}, 1);
  Random random(3);
  std::vector<Eigen::Quaterniond> turns;
  for (Rigid3& pose : problem.cams_from_world) {
    turns.emplace_back(RotationFromVector(3.0 * RandomVector(random)));
    pose = Rigid3::FromCentre(turns.back() * pose.rotation, pose.Centre());
  }
  for (BundleObservation& seen : problem.observations) {
    seen.bearing = turns[seen.pose] * seen.bearing;
  }
  for (DirectionPrior& prior : problem.direction_priors) {
    prior.direction_in_cam = turns[prior.pose] * prior.direction_in_cam;
  }
  const PoseCovariances after = EstimatePoseCovariances(problem, {}, 1);
  for (size_t i = 0; i < before.poses.size(); ++i) {
    EXPECT_LT((*before.poses[i] - *after.poses[i]).norm(), 1e-6 * before.poses[i]->norm());
  }
}

TEST(PoseCovariance, IsTheSameBytesForAnyNumberOfThreads) {
  const BundleProblem problem = StreetWithPriors(4).start;
  const PoseCovariances one = EstimatePoseCovariances(problem, {}, 1);
  const PoseCovariances three = EstimatePoseCovariances(problem, {}, 3);
  for (size_t i = 0; i < one.poses.size(); ++i) EXPECT_EQ(*one.poses[i], *three.poses[i]);
}

// (w, C) of the estimate against the truth.
Vector6 ErrorOf(const Rigid3& estimate, const Rigid3& truth) {
  const Eigen::AngleAxisd turn(truth.rotation.conjugate() * estimate.rotation);
  Vector6 error;
  error << turn.angle() * turn.axis(), estimate.Centre() - truth.Centre();
  return error;
}

double SquaredSigmas(const PoseCovariances& covariances,
                     size_t pose,
                     const BundleProblem& estimate,
                     const BundleProblem& truth) {
  const Vector6 error = ErrorOf(estimate.cams_from_world[pose], truth.cams_from_world[pose]);
  return error.dot(covariances.poses[pose]->llt().solve(error));
}

// The interval of chi^2 / (6 x kWorlds) that holds 99.9 %; a sigma that is wrong by a factor of 1.5
// would end near 0.44 or 2.25.
constexpr uint64_t kWorlds = 60;
constexpr double kLow = 0.77;
constexpr double kHigh = 1.26;

TEST(PoseCovariance, IsThatOfErrorsAgainstTheTruthWithPositions) {
  double sum = 0.0;
  for (uint64_t seed = 1; seed <= kWorlds; ++seed) {
    BundleWorld world = StreetWithPriors(seed);
    ASSERT_TRUE(AdjustBundle(world.start, kLeastSquaresToTheEnd, {}).ok());
    const PoseCovariances covariances = EstimatePoseCovariances(world.start, {}, 1);
    sum += SquaredSigmas(covariances, 7, world.start, world.truth);
  }
  const double ratio = sum / (6.0 * kWorlds);
  EXPECT_GT(ratio, kLow);
  EXPECT_LT(ratio, kHigh);
}

TEST(PoseCovariance, IsThatOfErrorsAgainstTheTruthRelativeToTheHeldPose) {
  double sum = 0.0;
  for (uint64_t seed = 1; seed <= kWorlds; ++seed) {
    BundleWorld world = MakeBundleWorld({.num_poses = 15, .num_points = 250, .seed = seed});
    for (const size_t held : {0U, 14U}) {
      world.start.cams_from_world[held] = world.truth.cams_from_world[held];
    }
    ASSERT_TRUE(AdjustBundle(world.start, kLeastSquaresToTheEnd, {}).ok());
    const PoseCovariances covariances = EstimatePoseCovariances(world.start, {}, 1);
    ASSERT_EQ(covariances.farthest, 14U);
    sum += SquaredSigmas(covariances, 7, world.start, world.truth);
  }
  const double ratio = sum / (6.0 * kWorlds);
  EXPECT_GT(ratio, kLow);
  EXPECT_LT(ratio, kHigh);
}

TEST(PoseCovariance, CountsTheBiasOfADrive) {
  BundleWorld world = StreetWithPriors(5);
  world.start.bias_sigma_m = {5.0};
  for (PositionPrior& prior : world.start.position_priors) prior.bias_group = 0;
  ASSERT_TRUE(AdjustBundle(world.start, kLeastSquaresToTheEnd, {}).ok());
  const PoseCovariances covariances =
      EstimatePoseCovariances(world.start, {Eigen::Vector3d::Zero()}, 1);
  for (const auto& pose : covariances.poses) EXPECT_NEAR(std::sqrt((*pose)(3, 3)), 5.0, 0.1);
}

// Leaves `pose` its first `count` observations and no prior.
void Blindfold(uint32_t pose, int count, BundleProblem& problem) {
  std::erase_if(problem.observations,
                [&](const BundleObservation& seen) { return seen.pose == pose && count-- <= 0; });
  std::erase_if(problem.position_priors,
                [&](const PositionPrior& prior) { return prior.pose == pose; });
  std::erase_if(problem.direction_priors,
                [&](const DirectionPrior& prior) { return prior.pose == pose; });
}

TEST(PoseCovariance, GrowsWhereHardlyAnythingIsSeen) {
  for (const int count : {1, 2, 3}) {
    BundleProblem problem = StreetWithPriors(6).start;
    Blindfold(4, count, problem);
    ASSERT_TRUE(AdjustBundle(problem, kLeastSquaresToTheEnd, {}).ok());
    const PoseCovariances covariances = EstimatePoseCovariances(problem, {}, 1);
    ASSERT_EQ(covariances.reason, "") << count;
    const double blind = covariances.poses[4]->topLeftCorner<3, 3>().trace();
    const double neighbour = covariances.poses[3]->topLeftCorner<3, 3>().trace();
    EXPECT_GT(blind, (count < 3 ? 1e4 : 2.0) * neighbour) << count;
    EXPECT_LT(std::sqrt(neighbour), 0.01) << count;
  }
}

TEST(PoseCovariance, IsUnknownForAPoseThatSeesNothing) {
  BundleProblem problem = StreetWithPriors(7).start;
  Blindfold(4, 0, problem);
  const PoseCovariances covariances = EstimatePoseCovariances(problem, {}, 1);
  EXPECT_EQ(covariances.reason, "");
  EXPECT_FALSE(covariances.poses[4].has_value());
  EXPECT_TRUE(covariances.poses[5].has_value());
}

TEST(PoseCovariance, SaysWhyThereIsNone) {
  BundleProblem problem = StreetWithPriors(8).start;
  problem.points_in_world[problem.observations[0].point].x() =
      std::numeric_limits<double>::quiet_NaN();
  const PoseCovariances covariances = EstimatePoseCovariances(problem, {}, 1);
  EXPECT_NE(covariances.reason, "");
  EXPECT_FALSE(covariances.poses[0].has_value());
}

TEST(PoseCovariance, AcceptsAnEmptyProblem) {
  EXPECT_TRUE(EstimatePoseCovariances({}, {}, 1).poses.empty());
}

}  // namespace
}  // namespace orbweave
