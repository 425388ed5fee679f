// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/judge_trial.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

constexpr auto kPoint = SeparatorId::Kind::kPoint;
constexpr auto kPose = SeparatorId::Kind::kPose;

TEST(JudgeTrial, AddsSubproblemsAndChoosesTheStepsOfSharedPointsByTheirWholeCost) {
  const std::vector<std::vector<SeparatorId>> separators = {
      {{kPose, 3}, {kPoint, 5}, {kPoint, 8}}, {{kPose, 3}, {kPoint, 5}}, {{kPoint, 8}}};
  // Point 5 gets better for the first subproblem and much worse for the second; 8 gets better.
  const std::vector<TrialCost> costs = {
      {.cost = 10.0,
       .predicted_decrease = 1.0,
       .retained_points = {{.cost_before = 2.0, .after = {{{1.0}, {1.5}, {2.0}}}},
                           {.cost_before = 4.0, .after = {{{1.0}, {3.0}, {4.0}}}}}},
      {.cost = 20.0,
       .predicted_decrease = 2.0,
       .retained_points = {{.cost_before = 1.0, .after = {{{9.0, true}, {1.25}, {1.5}}}}}},
      {.cost = 30.0,
       .predicted_decrease = 4.0,
       .retained_points = {{.cost_before = 4.0, .after = {{{2.0}, {3.0}, {4.0}}}}}}};
  const JudgedTrial judged = JudgeTrial(separators, costs, 8.0);
  EXPECT_DOUBLE_EQ(judged.predicted_decrease, 15.0);
  EXPECT_DOUBLE_EQ(judged.cost, 60.0 + (1.5 + 1.25) + (1.0 + 2.0));
  ASSERT_EQ(judged.shortened.size(), 1U);
  EXPECT_EQ(judged.shortened[0].point, 5U);
  EXPECT_DOUBLE_EQ(judged.shortened[0].share, 0.25);
}

TEST(JudgeTrial, OfNothingIsNothing) {
  const JudgedTrial judged = JudgeTrial({}, {}, 0.0);
  EXPECT_EQ(judged.cost, 0.0);
  EXPECT_TRUE(judged.shortened.empty());
}

}  // namespace
}  // namespace orbweave
