// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/partitioned_ba/divide_bundle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/bundle/adjust_bundle.h"
#include "core/bundle/bundle_report.h"
#include "core/partitioned_ba/subproblem_eliminator.h"
#include "tests/core/partitioned_ba/corridor_problem.h"

namespace orbweave {
namespace {

BundleProblem GridWithEverything() {
  return MakeCorridorProblem({.shape = CorridorShape::kGrid, .has_priors = true});
}

TEST(DivideBundle, CostsOfTheSubproblemsAddUpToTheWhole) {
  BundleProblem problem = GridWithEverything();
  double sum = 0.0;
  const std::vector<BundleSubproblem> subproblems =
      DivideBundle(problem, ConsecutiveOwners(60, 7), 7);
  for (const BundleSubproblem& subproblem : subproblems)
    sum += SubproblemEliminator(subproblem, {}, 1).Start().cost.cost;
  const absl::StatusOr<BundleReport> whole = AdjustBundle(problem, {.max_iterations = 1}, {});
  ASSERT_TRUE(whole.ok());
  EXPECT_NEAR(sum, whole->initial_cost, 1e-12 * sum);
}

TEST(DivideBundle, GivesEachTermToOneSubproblem) {
  const BundleProblem problem = GridWithEverything();
  size_t observations = 0;
  size_t positions = 0;
  size_t directions = 0;
  std::multiset<uint32_t> bias_priors;
  for (const BundleSubproblem& subproblem : DivideBundle(problem, ConsecutiveOwners(60, 7), 7)) {
    observations += subproblem.problem.observations.size();
    positions += subproblem.problem.position_priors.size();
    directions += subproblem.problem.direction_priors.size();
    for (size_t i = 0; i < subproblem.bias_ids.size(); ++i) {
      if (std::isfinite(subproblem.problem.bias_sigma_m[i]))
        bias_priors.insert(subproblem.bias_ids[i]);
    }
  }
  EXPECT_EQ(observations, problem.observations.size());
  EXPECT_EQ(positions, problem.position_priors.size());
  EXPECT_EQ(directions, problem.direction_priors.size());
  EXPECT_EQ(bias_priors, (std::multiset<uint32_t>{0, 1}));
}

TEST(DivideBundle, SeparatorsAreWhatTwoSubproblemsUse) {
  const BundleProblem problem = GridWithEverything();
  const std::vector<BundleSubproblem> subproblems =
      DivideBundle(problem, ConsecutiveOwners(60, 7), 7);
  std::map<SeparatorId, int> uses;
  std::map<SeparatorId, int> listed;
  for (const BundleSubproblem& subproblem : subproblems) {
    for (const uint32_t pose : subproblem.pose_ids) ++uses[{SeparatorId::Kind::kPose, pose}];
    for (const uint32_t group : subproblem.bias_ids) ++uses[{SeparatorId::Kind::kBias, group}];
    for (const uint32_t point : subproblem.point_ids) ++uses[{SeparatorId::Kind::kPoint, point}];
    EXPECT_TRUE(std::is_sorted(subproblem.separators.begin(), subproblem.separators.end()));
    for (const SeparatorId& id : subproblem.separators) ++listed[id];
  }
  std::erase_if(uses, [](const auto& use) { return use.second < 2; });
  EXPECT_EQ(listed, uses);
}

TEST(DivideBundle, GatherPutsEverythingBack) {
  const BundleProblem problem = GridWithEverything();
  BundleProblem gathered = problem;
  for (Rigid3& pose : gathered.cams_from_world) pose = Rigid3{};
  GatherBundle(DivideBundle(problem, ConsecutiveOwners(60, 7), 7), gathered);
  EXPECT_TRUE(SameBytes(gathered, problem));
}

}  // namespace
}  // namespace orbweave
