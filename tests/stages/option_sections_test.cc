// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/option_sections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Sections = OptionSections<MatchOptions, TwoViewOptions>;

TEST(OptionSections, AreNamedAsInTheOptionsOfAJob) {
  EXPECT_THAT(Sections::Names(), ElementsAre("matching", "two_view"));
  EXPECT_TRUE(OptionSections<>::Names().empty());
}

TEST(OptionSections, ReadWhatAJobStates) {
  PipelineOptions job;
  ASSERT_TRUE(SetPipelineOption(job, "matching.max_ratio=0.5").ok());
  ASSERT_TRUE(SetPipelineOption(job, "two_view.solver=eight_point").ok());
  const std::string text =
      OptionsToText("matching", job.matching) + OptionsToText("two_view", job.two_view);
  const auto sections = Sections::FromText(text, "test");
  ASSERT_TRUE(sections.ok()) << sections.status();
  EXPECT_EQ(sections->Get<MatchOptions>().max_ratio, 0.5);
  EXPECT_EQ(sections->Get<TwoViewOptions>().solver, TwoViewSolver::kEightPoint);
}

TEST(OptionSections, RefuseSectionsThatAreNotDeclared) {
  const auto sections = Sections::FromText("mapping.min_inliers=17\n", "test");
  EXPECT_TRUE(absl::IsInvalidArgument(sections.status()));
  EXPECT_THAT(std::string(sections.status().message()), HasSubstr("mapping.min_inliers"));
  EXPECT_FALSE(Sections::FromText("matching.no_such_option=1\n", "test").ok());
  EXPECT_FALSE(Sections::FromText("matching.max_ratio=7\n", "test").ok());
}

}  // namespace
}  // namespace orbweave
