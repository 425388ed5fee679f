// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/plan_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

using Kind = InputRule::Kind;

/// first: one part; fan: a part per recipe of first; last: first's output 1 and all outputs of fan.
JobPlan FanPlan() {
  return {"fan",
          {{.stage = "first",
            .version = "1",
            .inputs = {{Kind::kJobInput, "", 0}},
            .option_sections = {"a"}},
           {.stage = "fan",
            .version = "2",
            .parts_from = "first",
            .inputs = {{Kind::kJobInput, "", 0}, {Kind::kRecipe, "", 0}}},
           {.stage = "last",
            .version = "1",
            .inputs = {{Kind::kOutput, "first", 1}, {Kind::kAllOutputs, "fan", 0}}}}};
}

const JobSpec kJob{.kind = "fan", .inputs = {DigestOf("input")}, .options_text = "a.x=1\nb.y=2\n"};

TaskResult FirstResult() {
  return {.outputs = {DigestOf("o0"), DigestOf("o1")}, .recipes = {DigestOf("r0"), DigestOf("r1")}};
}

TEST(PlanStage, GivesAnUndividedStageOneTaskWithItsOwnOptions) {
  const auto plan = PlanStage(FanPlan(), 0, kJob, {}, {});
  ASSERT_TRUE(plan.ok());
  ASSERT_EQ(plan->tasks.size(), 1U);
  EXPECT_EQ(plan->tasks[0].stage, "first");
  EXPECT_EQ(plan->tasks[0].options_text, "a.x=1\n");
  EXPECT_THAT(plan->tasks[0].inputs, ::testing::ElementsAre(DigestOf("input")));
  EXPECT_TRUE(plan->collections.empty());
}

TEST(PlanStage, GivesEachRecipeAPart) {
  const auto plan = PlanStage(FanPlan(), 1, kJob, {{FirstResult()}}, {});
  ASSERT_TRUE(plan.ok());
  ASSERT_EQ(plan->tasks.size(), 2U);
  for (uint32_t part = 0; part < 2; ++part) {
    EXPECT_EQ(plan->tasks[part].part, part);
    EXPECT_THAT(plan->tasks[part].inputs,
                ::testing::ElementsAre(DigestOf("input"), DigestOf("r" + std::to_string(part))));
  }
}

TEST(PlanStage, CollectsAllOutputsInPartOrder) {
  const std::vector<TaskResult> fan = {{.outputs = {DigestOf("p0")}},
                                       {.outputs = {DigestOf("p1"), DigestOf("p2")}}};
  const auto plan = PlanStage(FanPlan(), 2, kJob, {{FirstResult()}, fan}, {});
  ASSERT_TRUE(plan.ok());
  const std::string collection = EncodeCollection({DigestOf("p0"), DigestOf("p1"), DigestOf("p2")});
  EXPECT_THAT(plan->collections, ::testing::ElementsAre(collection));
  EXPECT_THAT(plan->tasks.at(0).inputs,
              ::testing::ElementsAre(DigestOf("o1"), DigestOf(collection)));
}

TEST(PlanStage, CollectsOneOutputOfEachPart) {
  JobPlan plan = FanPlan();
  plan.stages[2].inputs = {{Kind::kCollection, "fan", 1}};
  const std::vector<TaskResult> fan = {{.outputs = {DigestOf("p0"), DigestOf("q0")}},
                                       {.outputs = {DigestOf("p1"), DigestOf("q1")}}};
  const auto last = PlanStage(plan, 2, kJob, {{FirstResult()}, fan}, {});
  ASSERT_TRUE(last.ok());
  EXPECT_THAT(last->collections,
              ::testing::ElementsAre(EncodeCollection({DigestOf("q0"), DigestOf("q1")})));
  const std::vector<TaskResult> short_fan = {{.outputs = {DigestOf("p0")}}};
  EXPECT_FALSE(PlanStage(plan, 2, kJob, {{FirstResult()}, short_fan}, {}).ok());
}

/// decide reads what it and the parts of work left in the round before; work follows its recipes.
JobPlan LoopPlan() {
  return {"loop",
          {{.stage = "decide",
            .version = "1",
            .inputs = {{Kind::kOutput, "decide", 0}, {Kind::kCollection, "work", 0}}},
           {.stage = "work",
            .version = "1",
            .parts_from = "decide",
            .inputs = {{Kind::kRecipe, "", 0}},
            .back_to = "decide"}}};
}

TEST(PlanStage, ALoopReadsTheRoundBeforeAndInTheFirstTheEmptyBlob) {
  const auto first = PlanStage(LoopPlan(), 0, kJob, {}, {});
  ASSERT_TRUE(first.ok());
  EXPECT_THAT(first->tasks.at(0).inputs, ::testing::ElementsAre(DigestOf(""), DigestOf("")));
  EXPECT_THAT(first->collections, ::testing::ElementsAre("", ""));

  const TaskResult decided = {.outputs = {DigestOf("o")}, .recipes = {DigestOf("r")}};
  const TaskResult worked = {.outputs = {DigestOf("w")}};
  const auto second = PlanStage(LoopPlan(), 0, kJob, {{decided}, {worked}}, {});
  ASSERT_TRUE(second.ok());
  EXPECT_THAT(second->tasks.at(0).inputs,
              ::testing::ElementsAre(DigestOf("o"), DigestOf(EncodeCollection({DigestOf("w")}))));
}

TEST(PlanStage, GivesNoTaskWhenThereIsNoRecipe) {
  TaskResult first = FirstResult();
  first.recipes.clear();
  const auto plan = PlanStage(FanPlan(), 1, kJob, {{first}}, {});
  ASSERT_TRUE(plan.ok());
  EXPECT_TRUE(plan->tasks.empty());
}

TEST(PlanStage, GivesEachListedRecipeAPart) {
  const JobPlan listed{"listed",
                       {{.stage = "verify",
                         .version = "1",
                         .parts_listed_in = 1,
                         .inputs = {{Kind::kRecipe, "", 0}}}}};
  const auto plan = PlanStage(listed, 0, kJob, {}, {DigestOf("x"), DigestOf("y")});
  ASSERT_TRUE(plan.ok());
  ASSERT_EQ(plan->tasks.size(), 2U);
  EXPECT_THAT(plan->tasks[1].inputs, ::testing::ElementsAre(DigestOf("y")));
}

TEST(PlanStage, NamesWhatIsMissing) {
  JobSpec no_inputs = kJob;
  no_inputs.inputs.clear();
  EXPECT_TRUE(absl::IsInvalidArgument(PlanStage(FanPlan(), 0, no_inputs, {}, {}).status()));
  TaskResult one_output = FirstResult();
  one_output.outputs.pop_back();
  const auto plan = PlanStage(FanPlan(), 2, kJob, {{one_output}, {}}, {});
  EXPECT_TRUE(absl::IsFailedPrecondition(plan.status()));
  EXPECT_THAT(std::string(plan.status().message()), ::testing::HasSubstr("first left no output 1"));
}

TEST(PlanStage, RefusesAStageWithoutVersion) {
  JobPlan plan = FanPlan();
  plan.stages[0].version.clear();
  const auto stage = PlanStage(plan, 0, {.kind = "fan", .inputs = {DigestOf("a")}}, {}, {});
  EXPECT_TRUE(absl::IsFailedPrecondition(stage.status()));
  EXPECT_NE(stage.status().message().find("first"), std::string::npos) << stage.status();
}

}  // namespace
}  // namespace orbweave
