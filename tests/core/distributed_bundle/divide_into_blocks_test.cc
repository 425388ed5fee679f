// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/distributed_bundle/divide_into_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/distributed_bundle/block_solver.h"
#include "tests/core/distributed_bundle/corridor_problem.h"

namespace orbweave {
namespace {

BundleProblem GridWithEverything() {
  return MakeCorridorProblem({.shape = CorridorShape::kGrid, .has_priors = true});
}

TEST(DivideIntoBlocks, CostsOfTheBlocksAddUpToTheWhole) {
  BundleProblem problem = GridWithEverything();
  double sum = 0.0;
  const std::vector<AdjustmentBlock> blocks =
      DivideIntoBlocks(problem, ConsecutiveOwners(60, 7), 7);
  for (const AdjustmentBlock& block : blocks) sum += BlockSolver(block, {}, 1).Start().cost.cost;
  const absl::StatusOr<BundleReport> whole = AdjustBundle(problem, {.max_iterations = 1}, {});
  ASSERT_TRUE(whole.ok());
  EXPECT_NEAR(sum, whole->initial_cost, 1e-12 * sum);
}

TEST(DivideIntoBlocks, GivesEachTermToOneBlock) {
  const BundleProblem problem = GridWithEverything();
  size_t observations = 0;
  size_t positions = 0;
  size_t directions = 0;
  std::multiset<uint32_t> bias_priors;
  for (const AdjustmentBlock& block : DivideIntoBlocks(problem, ConsecutiveOwners(60, 7), 7)) {
    observations += block.problem.observations.size();
    positions += block.problem.position_priors.size();
    directions += block.problem.direction_priors.size();
    for (size_t i = 0; i < block.bias_ids.size(); ++i) {
      if (std::isfinite(block.problem.bias_sigma_m[i])) bias_priors.insert(block.bias_ids[i]);
    }
  }
  EXPECT_EQ(observations, problem.observations.size());
  EXPECT_EQ(positions, problem.position_priors.size());
  EXPECT_EQ(directions, problem.direction_priors.size());
  EXPECT_EQ(bias_priors, (std::multiset<uint32_t>{0, 1}));
}

TEST(DivideIntoBlocks, SeparatorsAreWhatTwoBlocksUse) {
  const BundleProblem problem = GridWithEverything();
  const std::vector<AdjustmentBlock> blocks =
      DivideIntoBlocks(problem, ConsecutiveOwners(60, 7), 7);
  std::map<SeparatorId, int> uses;
  std::map<SeparatorId, int> listed;
  for (const AdjustmentBlock& block : blocks) {
    for (const uint32_t pose : block.pose_ids) ++uses[{SeparatorId::Kind::kPose, pose}];
    for (const uint32_t group : block.bias_ids) ++uses[{SeparatorId::Kind::kBias, group}];
    for (const uint32_t point : block.point_ids) ++uses[{SeparatorId::Kind::kPoint, point}];
    EXPECT_TRUE(std::is_sorted(block.separators.begin(), block.separators.end()));
    for (const SeparatorId& id : block.separators) ++listed[id];
  }
  std::erase_if(uses, [](const auto& use) { return use.second < 2; });
  EXPECT_EQ(listed, uses);
}

TEST(DivideIntoBlocks, GatherPutsEverythingBack) {
  const BundleProblem problem = GridWithEverything();
  BundleProblem gathered = problem;
  for (Rigid3& pose : gathered.cams_from_world) pose = Rigid3{};
  GatherBlocks(DivideIntoBlocks(problem, ConsecutiveOwners(60, 7), 7), gathered);
  EXPECT_TRUE(SameBytes(gathered, problem));
}

}  // namespace
}  // namespace orbweave
