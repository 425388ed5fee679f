// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/distributed_bundle/adjust_in_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/core/distributed_bundle/corridor_problem.h"

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

BlockwiseReport Adjust(BundleProblem& problem,
                       const std::vector<uint32_t>& owners,
                       const BundleOptions& options,
                       int num_threads = 1) {
  const uint32_t num_blocks = *std::max_element(owners.begin(), owners.end()) + 1;
  const absl::StatusOr<BlockwiseReport> report =
      AdjustInBlocks(problem, owners, num_blocks, options, {.num_threads = num_threads});
  EXPECT_TRUE(report.ok()) << report.status();
  return report.value_or(BlockwiseReport{});
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
  for (const uint32_t num_blocks : {1U, 2U, 5U, 13U}) {
    SCOPED_TRACE(num_blocks);
    BundleProblem copy = problem;
    const std::vector<uint32_t> owners =
        ConsecutiveOwners(problem.cams_from_world.size(), num_blocks);
    ExpectSamePath(expected, Adjust(copy, owners, options).accepted_costs);
  }
}

constexpr CorridorShape kShapes[] = {
    CorridorShape::kBends, CorridorShape::kLoop, CorridorShape::kGrid};

TEST(AdjustInBlocks, TakesTheStepsOfOneProcess) {
  for (const CorridorShape shape : kShapes) {
    SCOPED_TRACE(internal::ValueToText(shape));
    ExpectPathOfOneProcess(MakeCorridorProblem({.shape = shape}),
                           {.loss = BundleLoss::kLeastSquares});
  }
}

TEST(AdjustInBlocks, TakesTheStepsOfOneProcessWithARobustLoss) {
  for (const CorridorShape shape : kShapes) {
    SCOPED_TRACE(internal::ValueToText(shape));
    ExpectPathOfOneProcess(MakeCorridorProblem({.shape = shape, .outlier_share = 0.02}),
                           {.loss = BundleLoss::kCauchy});
  }
}

TEST(AdjustInBlocks, TakesTheStepsOfOneProcessWithPriorsAndBiases) {
  for (const CorridorShape shape : kShapes) {
    SCOPED_TRACE(internal::ValueToText(shape));
    ExpectPathOfOneProcess(
        MakeCorridorProblem({.shape = shape, .outlier_share = 0.02, .has_priors = true}), {});
  }
}

TEST(AdjustInBlocks, TakesTheStepsOfOneProcessWithFixedPosesAndPoints) {
  for (const CorridorShape shape : kShapes) {
    SCOPED_TRACE(internal::ValueToText(shape));
    ExpectPathOfOneProcess(MakeCorridorProblem({.shape = shape, .has_fixed = true}),
                           {.loss = BundleLoss::kHuber});
  }
}

// Rejected steps and shortened points, those of separators among them.
TEST(AdjustInBlocks, TakesTheStepsOfOneProcessFromABadStart) {
  BundleProblem problem = MakeCorridorProblem({.features_per_panorama = 30, .outlier_share = 0.1});
  Random random(5);
  for (Eigen::Vector3d& point : problem.points_in_world) point += NoiseVector(random, 3.0);
  ExpectPathOfOneProcess(problem, {.max_iterations = 12, .initial_lambda = 1e-3});
}

TEST(AdjustInBlocks, FindsTheAnswerOfOneProcess) {
  const BundleProblem problem = MakeCorridorProblem({.has_priors = true});
  BundleProblem whole = problem;
  BundleProblem divided = problem;
  const absl::StatusOr<BundleReport> expected = AdjustBundle(whole, {}, {});
  ASSERT_TRUE(expected.ok());
  const BlockwiseReport report = Adjust(divided, ConsecutiveOwners(60, 5), {});
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

TEST(AdjustInBlocks, HoldsScaleAndAnchorOfTheGauge) {
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

TEST(AdjustInBlocks, GivesTheSameBytesForAnyNumberOfThreads) {
  const BundleProblem problem = MakeCorridorProblem(
      {.shape = CorridorShape::kGrid, .outlier_share = 0.02, .has_priors = true});
  BundleProblem one = problem;
  BundleProblem three = problem;
  Adjust(one, ConsecutiveOwners(60, 7), {}, 1);
  Adjust(three, ConsecutiveOwners(60, 7), {}, 3);
  EXPECT_TRUE(SameBytes(one, three));
}

TEST(AdjustInBlocks, SendsNoMoreOnALongerStreet) {
  size_t bytes_of_short = 0;
  for (const int panoramas : {120, 480}) {
    BundleProblem problem =
        MakeCorridorProblem({.panoramas = panoramas, .features_per_panorama = 60});
    const std::vector<uint32_t> owners =
        ConsecutiveOwners(problem.cams_from_world.size(), static_cast<uint32_t>(panoramas) / 40);
    const BlockwiseReport report = Adjust(problem, owners, {.max_iterations = 1});
    const uint32_t most =
        *std::max_element(report.separators_of_block.begin(), report.separators_of_block.end());
    EXPECT_LE(most, 40U);
    const size_t largest = std::max(report.largest_node_bytes,
                                    *std::max_element(report.message_bytes_of_block.begin(),
                                                      report.message_bytes_of_block.end()));
    EXPECT_LT(largest, size_t{2} << 20);
    if (bytes_of_short == 0) bytes_of_short = largest;
    EXPECT_LE(largest, 2 * bytes_of_short);
  }
}

TEST(AdjustInBlocks, AllowsBlocksWithoutSeparatorsAndEmptyOnes) {
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
  const BlockwiseReport report = Adjust(problem, owners, {});
  EXPECT_EQ(report.separators_of_block, (std::vector<uint32_t>{0, 0, 0, 0}));
  ExpectSamePath(expected, report.accepted_costs);
}

TEST(AdjustInBlocks, AllowsABlockPerPanorama) {
  const BundleProblem problem = MakeCorridorProblem({.panoramas = 16, .has_priors = true});
  BundleProblem divided = problem;
  std::vector<uint32_t> owners(16);
  std::iota(owners.begin(), owners.end(), 0U);
  ExpectSamePath(CostPath(problem, {}), Adjust(divided, owners, {}).accepted_costs);
}

TEST(AdjustInBlocks, AllowsAPanoramaThatSeesNothing) {
  BundleProblem problem = MakeCorridorProblem({.panoramas = 20});
  std::erase_if(problem.observations, [](const BundleObservation& seen) { return seen.pose == 7; });
  const Rigid3 before = problem.cams_from_world[7];
  const std::vector<double> expected = CostPath(problem, {});
  ExpectSamePath(expected, Adjust(problem, ConsecutiveOwners(20, 3), {}).accepted_costs);
  EXPECT_LT((problem.cams_from_world[7].Centre() - before.Centre()).norm(), 1e-12);
}

TEST(AdjustInBlocks, RefusesAnOwnerOutOfRange) {
  BundleProblem problem = MakeCorridorProblem({.panoramas = 10});
  std::vector<uint32_t> owners(10, 0);
  EXPECT_EQ(AdjustInBlocks(problem, owners, 0, {}, {}).status().code(),
            absl::StatusCode::kInvalidArgument);
  owners[4] = 2;
  EXPECT_EQ(AdjustInBlocks(problem, owners, 2, {}, {}).status().code(),
            absl::StatusCode::kInvalidArgument);
  owners.pop_back();
  EXPECT_EQ(AdjustInBlocks(problem, owners, 3, {}, {}).status().code(),
            absl::StatusCode::kInvalidArgument);
}

TEST(AdjustInBlocks, StopsOnRequest) {
  BundleProblem problem = MakeCorridorProblem({.panoramas = 10});
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(AdjustInBlocks(problem, ConsecutiveOwners(10, 2), 2, {}, {.stop = stop.get_token()})
                .status()
                .code(),
            absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
