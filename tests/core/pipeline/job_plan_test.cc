// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/job_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

std::vector<std::string> StageNames(const JobPlan& plan) {
  std::vector<std::string> names;
  for (const StageRule& rule : plan.stages) names.push_back(rule.stage);
  return names;
}

TEST(FindJobPlan, SparseLeadsFromImagesToAModel) {
  const auto plan = FindJobPlan("sparse");
  ASSERT_TRUE(plan.ok());
  EXPECT_THAT(StageNames(*plan),
              ::testing::ElementsAre("ingest_images",
                                     "extract_features",
                                     "select_image_pairs",
                                     "match_images",
                                     "partition_view_graph",
                                     "reconstruct_cluster",
                                     "list_seams",
                                     "fit_seams",
                                     "align_submodels",
                                     "review_seams",
                                     "join_submodels",
                                     "assemble_block",
                                     "steer_adjustment",
                                     "adjust_block",
                                     "conclude_adjustment"));
}

TEST(FindJobPlan, SparseFromMatchesBeginsWithVerification) {
  const auto plan = FindJobPlan("sparse_from_matches");
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->stages.front().stage, "verify_matches");
  EXPECT_EQ(plan->stages.front().parts_listed_in, 2U);
  EXPECT_EQ(plan->stages.back().stage, "conclude_adjustment");
}

TEST(FindJobPlan, RefusesAnUnknownKindByName) {
  const auto plan = FindJobPlan("dense");
  EXPECT_TRUE(absl::IsNotFound(plan.status()));
  EXPECT_THAT(std::string(plan.status().message()), ::testing::HasSubstr("dense"));
}

/// Last stage of the loop that stage `s` is in, or `s` itself.
size_t EndOfLoop(const JobPlan& plan, size_t s) {
  for (size_t end = s; end < plan.stages.size(); ++end) {
    const TaskResult asks_again{.recipes = {DigestOf("")}};
    if (StageAfter(plan, static_cast<uint32_t>(end), {asks_again}) <= s) return end;
  }
  return s;
}

TEST(FindJobPlan, EveryStageReadsOnlyStagesBeforeItOrOfItsLoop) {
  for (const char* kind : {"sparse", "sparse_from_matches"}) {
    const auto plan = FindJobPlan(kind);
    ASSERT_TRUE(plan.ok());
    std::vector<std::string> before = {""};
    for (size_t s = 0; s < plan->stages.size(); ++s) {
      const StageRule& rule = plan->stages[s];
      EXPECT_THAT(before, ::testing::Contains(rule.parts_from)) << rule.stage;
      std::vector<std::string> readable = before;
      const size_t end = EndOfLoop(*plan, s);
      for (size_t l = s; l <= end && end > s; ++l) readable.push_back(plan->stages[l].stage);
      if (end == s && !rule.back_to.empty()) readable.push_back(rule.stage);
      for (const InputRule& input : rule.inputs)
        EXPECT_THAT(readable, ::testing::Contains(input.stage)) << rule.stage;
      before.push_back(rule.stage);
    }
  }
}

TEST(SelectSections, KeepsLinesOfTheSectionsInOrder) {
  const std::string text = "align.a=1\nmatching.b=2\nmatch.c=3\nmatching.d=4\n";
  EXPECT_EQ(SelectSections(text, {"matching"}), "matching.b=2\nmatching.d=4\n");
  EXPECT_EQ(SelectSections(text, {"match", "align"}), "align.a=1\nmatch.c=3\n");
  EXPECT_EQ(SelectSections(text, {}), "");
  EXPECT_EQ(SelectSections("", {"match"}), "");
}

TEST(SelectSections, EndsTheLastLineEvenWhenTheTextDoesNot) {
  EXPECT_EQ(SelectSections("align.a=1", {"align"}), "align.a=1\n");
}

TEST(Collection, SurvivesTheRoundTrip) {
  const std::vector<Digest> digests = {DigestOf("a"), DigestOf("b"), DigestOf("a")};
  const auto decoded = DecodeCollection(EncodeCollection(digests));
  ASSERT_TRUE(decoded.ok());
  EXPECT_EQ(*decoded, digests);
  EXPECT_TRUE(DecodeCollection("")->empty());
}

TEST(Collection, RefusesATornList) {
  const std::string bytes = EncodeCollection({DigestOf("a")});
  EXPECT_TRUE(absl::IsInvalidArgument(DecodeCollection(bytes.substr(1)).status()));
}

TEST(StageAfter, GoesBackAsLongAsTheLoopHasParts) {
  const JobPlan plan{"loop",
                     {{.stage = "a"},
                      {.stage = "b"},
                      {.stage = "c", .parts_from = "b", .back_to = "b"},
                      {.stage = "d"}}};
  EXPECT_EQ(StageAfter(plan, 0, {TaskResult{}}), 1U);
  EXPECT_EQ(StageAfter(plan, 2, std::vector<TaskResult>(5)), 1U);
  EXPECT_EQ(StageAfter(plan, 2, {}), 3U);
  EXPECT_EQ(StageAfter(plan, 3, {TaskResult{}}), 4U);
}

TEST(StageAfter, GoesBackAsLongAsTheOnePartThatEndsTheLoopLeavesARecipe) {
  const JobPlan plan{"loop", {{.stage = "a"}, {.stage = "b", .back_to = "a"}, {.stage = "c"}}};
  EXPECT_EQ(StageAfter(plan, 1, {{.recipes = {DigestOf("more")}}}), 0U);
  EXPECT_EQ(StageAfter(plan, 1, {{.outputs = {DigestOf("enough")}}}), 2U);
}

}  // namespace
}  // namespace orbweave
