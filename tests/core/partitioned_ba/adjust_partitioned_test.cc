// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/partitioned_ba/adjust_partitioned.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/bundle/adjust_bundle.h"
#include "tests/core/partitioned_ba/corridor_problem.h"

namespace orbweave {
namespace {

// Accepted costs of AdjustBundle, the initial one first: by stopping it after each step.
std::vector<double> CostPath(const BundleProblem& problem, BundleOptions options) {
  const int max_iterations = options.max_iterations;
  std::vector<double> path;
  bool converged = false;
  for (options.max_iterations = 1; options.max_iterations <= max_iterations && !converged;
       ++options.max_iterations) {
    BundleProblem copy = problem;
    const absl::StatusOr<BundleReport> report = AdjustBundle(copy, options, {});
    EXPECT_TRUE(report.ok()) << report.status();
    if (path.empty()) path.push_back(report->initial_cost);
    if (report->final_cost < path.back()) path.push_back(report->final_cost);
    converged = report->converged;
  }
  return path;
}

PartitionedReport Adjust(BundleProblem& problem,
                         const std::vector<uint32_t>& owners,
                         const BundleOptions& options,
                         int num_threads = 1) {
  const uint32_t num_subproblems = *std::max_element(owners.begin(), owners.end()) + 1;
  const absl::StatusOr<PartitionedReport> report =
      AdjustPartitioned(problem, owners, num_subproblems, options, {.num_threads = num_threads});
  EXPECT_TRUE(report.ok()) << report.status();
  return report.value_or(PartitionedReport{});
}

void ExpectSamePath(const std::vector<double>& expected, const std::vector<double>& path) {
  ASSERT_EQ(path.size(), expected.size());
  for (size_t i = 0; i < path.size(); ++i) {
    EXPECT_NEAR(path[i], expected[i], 1e-9 * expected[i]) << "step " << i;
  }
}

void ExpectPathOfOneProcess(const BundleProblem& problem, const BundleOptions& options) {
  const std::vector<double> expected = CostPath(problem, options);
  EXPECT_GE(expected.size(), 3U);
  for (const uint32_t num_subproblems : {1U, 2U, 5U, 13U}) {
    SCOPED_TRACE(num_subproblems);
    BundleProblem copy = problem;
    const std::vector<uint32_t> owners =
        ConsecutiveOwners(problem.cams_from_world.size(), num_subproblems);
    ExpectSamePath(expected, Adjust(copy, owners, options).accepted_costs);
  }
}

constexpr CorridorShape kShapes[] = {
    CorridorShape::kBends, CorridorShape::kLoop, CorridorShape::kGrid};

TEST(AdjustPartitioned, TakesTheStepsOfOneProcess) {
  for (const CorridorShape shape : kShapes) {
    SCOPED_TRACE(internal::ValueToText(shape));
    ExpectPathOfOneProcess(MakeCorridorProblem({.shape = shape}),
                           {.loss = BundleLoss::kLeastSquares});
  }
}

TEST(AdjustPartitioned, TakesTheStepsOfOneProcessWithARobustLoss) {
  for (const CorridorShape shape : kShapes) {
    SCOPED_TRACE(internal::ValueToText(shape));
    ExpectPathOfOneProcess(MakeCorridorProblem({.shape = shape, .outlier_share = 0.02}),
                           {.loss = BundleLoss::kCauchy});
  }
}

TEST(AdjustPartitioned, TakesTheStepsOfOneProcessWithPriorsAndBiases) {
  for (const CorridorShape shape : kShapes) {
    SCOPED_TRACE(internal::ValueToText(shape));
    ExpectPathOfOneProcess(
        MakeCorridorProblem({.shape = shape, .outlier_share = 0.02, .has_priors = true}), {});
  }
}

TEST(AdjustPartitioned, TakesTheStepsOfOneProcessWithFixedPosesAndPoints) {
  for (const CorridorShape shape : kShapes) {
    SCOPED_TRACE(internal::ValueToText(shape));
    ExpectPathOfOneProcess(MakeCorridorProblem({.shape = shape, .has_fixed = true}),
                           {.loss = BundleLoss::kHuber});
  }
}

// Rejected steps and shortened points, those of separators among them.
TEST(AdjustPartitioned, TakesTheStepsOfOneProcessFromABadStart) {
  BundleProblem problem = MakeCorridorProblem({.features_per_panorama = 30, .outlier_share = 0.1});
  Random random(5);
  for (Eigen::Vector3d& point : problem.points_in_world) point += NoiseVector(random, 3.0);
  ExpectPathOfOneProcess(problem, {.max_iterations = 12, .initial_lambda = 1e-3});
}

TEST(AdjustPartitioned, FindsTheAnswerOfOneProcess) {
  const BundleProblem problem = MakeCorridorProblem({.has_priors = true});
  BundleProblem whole = problem;
  BundleProblem divided = problem;
  const absl::StatusOr<BundleReport> expected = AdjustBundle(whole, {}, {});
  ASSERT_TRUE(expected.ok());
  const PartitionedReport report = Adjust(divided, ConsecutiveOwners(60, 5), {});
  EXPECT_EQ(report.bundle.iterations, expected->iterations);
  EXPECT_EQ(report.bundle.converged, expected->converged);
  for (size_t i = 0; i < whole.cams_from_world.size(); ++i) {
    const Eigen::Vector3d difference =
        whole.cams_from_world[i].Centre() - divided.cams_from_world[i].Centre();
    EXPECT_LT(difference.norm(), 1e-7);
  }
  for (size_t g = 0; g < 2; ++g) {
    EXPECT_LT((report.bundle.biases_m[g] - expected->biases_m[g]).norm(), 1e-7);
  }
}

TEST(AdjustPartitioned, HoldsScaleAndAnchorOfTheGauge) {
  const BundleProblem problem = MakeCorridorProblem({});
  BundleProblem whole = problem;
  BundleProblem divided = problem;
  ASSERT_TRUE(AdjustBundle(whole, {}, {}).ok());
  Adjust(divided, ConsecutiveOwners(60, 5), {});
  EXPECT_TRUE(
      SameBytes(divided.cams_from_world[0].translation, problem.cams_from_world[0].translation));
  for (size_t i = 0; i < whole.cams_from_world.size(); ++i) {
    const Eigen::Vector3d difference =
        whole.cams_from_world[i].Centre() - divided.cams_from_world[i].Centre();
    EXPECT_LT(difference.norm(), 1e-6);
  }
}

TEST(AdjustPartitioned, GivesTheSameBytesForAnyNumberOfThreads) {
  const BundleProblem problem = MakeCorridorProblem(
      {.shape = CorridorShape::kGrid, .outlier_share = 0.02, .has_priors = true});
  BundleProblem one = problem;
  BundleProblem three = problem;
  Adjust(one, ConsecutiveOwners(60, 7), {}, 1);
  Adjust(three, ConsecutiveOwners(60, 7), {}, 3);
  EXPECT_TRUE(SameBytes(one, three));
}

TEST(AdjustPartitioned, SendsNoMoreOnALongerStreet) {
  size_t bytes_of_short = 0;
  for (const int panoramas : {120, 480}) {
    BundleProblem problem =
        MakeCorridorProblem({.panoramas = panoramas, .features_per_panorama = 60});
    const std::vector<uint32_t> owners =
        ConsecutiveOwners(problem.cams_from_world.size(), static_cast<uint32_t>(panoramas) / 40);
    const PartitionedReport report = Adjust(problem, owners, {.max_iterations = 1});
    const uint32_t most = *std::max_element(report.separators_of_subproblem.begin(),
                                            report.separators_of_subproblem.end());
    EXPECT_LE(most, 40U);
    const size_t largest = std::max(report.largest_node_bytes,
                                    *std::max_element(report.message_bytes_of_subproblem.begin(),
                                                      report.message_bytes_of_subproblem.end()));
    EXPECT_LT(largest, size_t{2} << 20);
    if (bytes_of_short == 0) bytes_of_short = largest;
    EXPECT_LE(largest, 2 * bytes_of_short);
  }
}

TEST(AdjustPartitioned, AllowsSubproblemsWithoutSeparatorsAndEmptyOnes) {
  BundleProblem problem = MakeCorridorProblem({.panoramas = 40, .has_priors = true});
  problem.bias_sigma_m.clear();
  std::erase_if(problem.direction_priors, [](const DirectionPrior&) { return true; });
  for (PositionPrior& prior : problem.position_priors) prior.bias_group.reset();
  // Two streets that share nothing: no track crosses from 19 to 20.
  std::vector<uint8_t> seen_by_first(problem.points_in_world.size(), 0);
  for (const BundleObservation& seen : problem.observations) {
    if (seen.pose < 20) seen_by_first[seen.point] = 1;
  }
  std::erase_if(problem.observations, [&](const BundleObservation& seen) {
    return seen.pose >= 20 && seen_by_first[seen.point];
  });
  const std::vector<double> expected = CostPath(problem, {});
  std::vector<uint32_t> owners(40, 1);
  std::fill(owners.begin() + 20, owners.end(), 3);  // 0 and 2 own nothing
  const PartitionedReport report = Adjust(problem, owners, {});
  EXPECT_EQ(report.separators_of_subproblem, (std::vector<uint32_t>{0, 0, 0, 0}));
  ExpectSamePath(expected, report.accepted_costs);
}

TEST(AdjustPartitioned, AllowsASubproblemPerPanorama) {
  const BundleProblem problem = MakeCorridorProblem({.panoramas = 16, .has_priors = true});
  BundleProblem divided = problem;
  std::vector<uint32_t> owners(16);
  std::iota(owners.begin(), owners.end(), 0U);
  ExpectSamePath(CostPath(problem, {}), Adjust(divided, owners, {}).accepted_costs);
}

TEST(AdjustPartitioned, AllowsAPanoramaThatSeesNothing) {
  BundleProblem problem = MakeCorridorProblem({.panoramas = 20});
  std::erase_if(problem.observations, [](const BundleObservation& seen) { return seen.pose == 7; });
  const Rigid3 before = problem.cams_from_world[7];
  const std::vector<double> expected = CostPath(problem, {});
  ExpectSamePath(expected, Adjust(problem, ConsecutiveOwners(20, 3), {}).accepted_costs);
  EXPECT_LT((problem.cams_from_world[7].Centre() - before.Centre()).norm(), 1e-12);
}

TEST(AdjustPartitioned, RefusesAnOwnerOutOfRange) {
  BundleProblem problem = MakeCorridorProblem({.panoramas = 10});
  std::vector<uint32_t> owners(10, 0);
  EXPECT_EQ(AdjustPartitioned(problem, owners, 0, {}, {}).status().code(),
            absl::StatusCode::kInvalidArgument);
  owners[4] = 2;
  EXPECT_EQ(AdjustPartitioned(problem, owners, 2, {}, {}).status().code(),
            absl::StatusCode::kInvalidArgument);
  owners.pop_back();
  EXPECT_EQ(AdjustPartitioned(problem, owners, 3, {}, {}).status().code(),
            absl::StatusCode::kInvalidArgument);
}

TEST(AdjustPartitioned, StopsOnRequest) {
  BundleProblem problem = MakeCorridorProblem({.panoramas = 10});
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(AdjustPartitioned(problem, ConsecutiveOwners(10, 2), 2, {}, {.stop = stop.get_token()})
                .status()
                .code(),
            absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
