// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/preset_options.h"

#include <gmock/gmock.h>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

PipelineOptions Read(std::string_view text, const std::vector<std::string>& assignments) {
  const auto options = OptionsOverPreset(text, "job.conf", assignments);
  EXPECT_TRUE(options.ok()) << options.status();
  return options.value_or(PipelineOptions{});
}

TEST(PresetOptions, WithoutAPresetDefaultsStay) {
  EXPECT_EQ(PipelineOptionsToText(Read("", {})), PipelineOptionsToText({}));
  EXPECT_EQ(PipelineOptionsToText(DefaultsOf(MappingPreset::kOrbweave)), PipelineOptionsToText({}));
}

TEST(PresetOptions, EveryAssignmentOfThePaperHolds) {
  const std::string text = PipelineOptionsToText(DefaultsOf(MappingPreset::kPaper));
  for (const std::string& assignment : AssignmentsOf(MappingPreset::kPaper))
    EXPECT_THAT(text, HasSubstr(assignment + "\n"));
}

TEST(PresetOptions, ThePaperChangesTheStagesAroundTheMapper) {
  const PipelineOptions options = Read("", {"mapping.preset=paper"});
  EXPECT_EQ(options.two_view.solver, TwoViewSolver::kEightPoint);
  EXPECT_EQ(options.bundle.residual, BundleResidual::kErpPx);
  EXPECT_EQ(options.bundle.loss, BundleLoss::kLeastSquares);
  EXPECT_FALSE(options.matching.guided);
  EXPECT_EQ(options.partition.cluster_size, 0);
}

TEST(PresetOptions, WhatIsSetCountsBeforeThePresetAndAfterIt) {
  const PipelineOptions before =
      Read("", {"two_view.solver=five_point", "mapping.preset=paper", "matching.guided=true"});
  EXPECT_EQ(before.two_view.solver, TwoViewSolver::kFivePoint);
  EXPECT_TRUE(before.matching.guided);
  EXPECT_EQ(before.bundle.residual, BundleResidual::kErpPx);
  const PipelineOptions in_file =
      Read("mapping.preset=paper\nbundle.residual=angle\n", {"partition.reviews=1"});
  EXPECT_EQ(in_file.bundle.residual, BundleResidual::kAngle);
  EXPECT_EQ(in_file.partition.reviews, 1);
  EXPECT_EQ(in_file.two_view.solver, TwoViewSolver::kEightPoint);
}

TEST(PresetOptions, ThePresetChosenLastCounts) {
  const PipelineOptions options = Read("mapping.preset=paper\n", {"mapping.preset=orbweave"});
  EXPECT_EQ(PipelineOptionsToText(options), PipelineOptionsToText({}));
}

TEST(PresetOptions, TheTextOfAJobMeansItself) {
  const PipelineOptions options = Read("", {"mapping.preset=paper", "two_view.solver=five_point"});
  const std::string text = PipelineOptionsToText(options);
  EXPECT_EQ(PipelineOptionsToText(*PipelineOptionsFromText(text, "job")), text);
  EXPECT_EQ(PipelineOptionsToText(Read(text, {})), text);
}

TEST(PresetOptions, SaysWhichLineIsWrong) {
  const absl::Status status = OptionsOverPreset("mapping.preset=payper\n", "job.conf", {}).status();
  EXPECT_THAT(status.ToString(), HasSubstr("job.conf line 1"));
  EXPECT_FALSE(OptionsOverPreset("", "", {"mapping.preset=payper"}).ok());
}

}  // namespace
}  // namespace orbweave
