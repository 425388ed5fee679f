// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>

#include "core/base/digest.h"
#include "stages/fit_seams/stage.h"
#include "stages/plans.h"
#include "tests/support/memory_blobs.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

TEST(FindStage, RefusesAnUnknownNameByName) {
  EXPECT_THAT(FindStage("no_such_stage").status().ToString(), HasSubstr("no_such_stage"));
  EXPECT_EQ(FindStageFunction("no_such_stage"), nullptr);
}

TEST(AllStages, HaveNamesOfTheirOwnVersionsAndWeights) {
  std::set<std::string_view> names;
  for (const Stage& stage : AllStages()) {
    EXPECT_TRUE(names.insert(stage.facts.name).second) << stage.facts.name;
    EXPECT_FALSE(stage.facts.version.empty()) << stage.facts.name;
    EXPECT_GT(stage.facts.weight, 0.0) << stage.facts.name;
    EXPECT_FALSE(stage.inputs.empty()) << stage.facts.name;
    EXPECT_FALSE(stage.outputs.empty()) << stage.facts.name;
  }
}

/// Every value that a stage reads comes from another machine: its decoder has a fuzz target.
TEST(AllStages, ReadBytesThatAFuzzTargetReadsToo) {
  const std::filesystem::path folder =
      std::filesystem::path(ORBWEAVE_SOURCE_DIR) / "tests" / "fuzz";
  for (const Stage& stage : AllStages()) {
    for (const std::vector<PortInfo>& ports : {stage.inputs, stage.outputs}) {
      for (const PortInfo& port : ports) {
        for (const std::string_view type : port.types) {
          EXPECT_TRUE(std::filesystem::exists(folder / (std::string(type) + "_fuzz.cc")))
              << stage.facts.name << " " << port.name << ": " << type;
        }
      }
    }
  }
}

TaskSpec FitSeamsTask() {
  return {.stage = "fit_seams",
          .version = std::string(FitSeamsStage::kFacts.version),
          .inputs = {DigestOf("")}};
}

TEST(FindStage, RunsNoTaskOfAnotherVersionOrWithOtherInputsOrOptions) {
  testing::MemoryBlobs blobs;
  ASSERT_TRUE(blobs.Put("").ok());
  const StageFunction& run = *FindStageFunction("fit_seams");
  EXPECT_THAT(run(FitSeamsTask(), blobs, {}).status().ToString(), HasSubstr("no cluster"));
  TaskSpec newer = FitSeamsTask();
  newer.version = "77";
  EXPECT_THAT(run(newer, blobs, {}).status().ToString(), HasSubstr("version 77"));
  TaskSpec more = FitSeamsTask();
  more.inputs.push_back(DigestOf(""));
  EXPECT_THAT(run(more, blobs, {}).status().ToString(), HasSubstr("reads 1 inputs, not 2"));
  TaskSpec others = FitSeamsTask();
  others.options_text = "mapping.min_inliers=17\n";
  EXPECT_THAT(run(others, blobs, {}).status().ToString(), HasSubstr("mapping.min_inliers"));
}

/// What follows into the names of tasks, but for the bytes they read.
std::string NamesOfTasks() {
  std::string text;
  for (const std::string& kind : JobKinds()) {
    const JobPlan plan = FindJobPlan(kind).value();
    for (const StageRule& rule : plan.stages) {
      text += rule.stage + " " + rule.version + ":";
      for (const std::string& section : rule.option_sections) text += " " + section;
      for (const InputRule& input : rule.inputs)
        text += ", " + input.stage + " " + std::to_string(input.index);
      text += "\n";
    }
  }
  return text;
}

/// Results in journals are found by these names. Whoever changes one on purpose raises a version;
/// every other change makes users compute anew what they have.
TEST(AllStages, KeepTheNamesOfTheirTasks) {
  EXPECT_EQ(DigestOf(NamesOfTasks()).ToShortHex(), "dfae744d31b1") << NamesOfTasks();
}

}  // namespace
}  // namespace orbweave
