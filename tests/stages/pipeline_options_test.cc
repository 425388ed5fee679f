// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/pipeline_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

TEST(PipelineOptions, TextRoundTrips) {
  PipelineOptions options;
  ASSERT_TRUE(SetPipelineOption(options, "mapping.min_inliers=17").ok());
  ASSERT_TRUE(SetPipelineOption(options, "two_view.solver = eight_point").ok());
  const std::string text = PipelineOptionsToText(options);
  const auto parsed = PipelineOptionsFromText(text, "test");
  ASSERT_TRUE(parsed.ok()) << parsed.status();
  EXPECT_EQ(PipelineOptionsToText(*parsed), text);
  EXPECT_EQ(parsed->mapping.min_inliers, 17);
  EXPECT_EQ(parsed->two_view.solver, TwoViewSolver::kEightPoint);
}

TEST(PipelineOptions, DefaultsAreWithinTheirRanges) {
  const PipelineOptions options;
  PipelineOptions::VisitSections(options, [](std::string_view section, const auto& fields) {
    EXPECT_TRUE(ValidateOptions(section, fields).ok()) << ValidateOptions(section, fields);
  });
}

TEST(PipelineOptions, NamesTheNearestOptionWhenOneIsMisspelt) {
  PipelineOptions options;
  const absl::Status status = SetPipelineOption(options, "mapping.min_inlier=20");
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(status.message()), HasSubstr("did you mean 'mapping.min_inliers'"));
}

TEST(PipelineOptions, SaysWhichLineOfAFileIsWrong) {
  const auto parsed =
      PipelineOptionsFromText("# a comment\n\nmapping.min_inliers=many\n", "job.conf");
  ASSERT_FALSE(parsed.ok());
  EXPECT_THAT(std::string(parsed.status().message()), HasSubstr("job.conf line 3"));
}

TEST(PipelineOptions, RefusesValuesOutOfRange) {
  PipelineOptions options;
  const absl::Status status = SetPipelineOption(options, "matching.max_ratio=7");
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(status.message()), HasSubstr("max_ratio=7 is outside [0.1, 1]"));
}

TEST(PipelineOptions, EveryOptionHasHelp) {
  for (const OptionInfo& info : DescribePipelineOptions({}))
    EXPECT_FALSE(info.help.empty()) << info.name;
}

}  // namespace
}  // namespace orbweave
