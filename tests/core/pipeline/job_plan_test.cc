// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/job_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

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
