// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/plans.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "stages/codecs.h"
#include "stages/registry.h"

namespace orbweave {
namespace {

using Kind = InputRule::Kind;

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
                                     "list_extractions",
                                     "extract_features",
                                     "select_image_pairs",
                                     "list_pairs",
                                     "match_images",
                                     "select_wider_pairs",
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
  const auto plan = FindJobPlan("no_such_kind");
  EXPECT_TRUE(absl::IsNotFound(plan.status()));
  EXPECT_THAT(std::string(plan.status().message()), ::testing::HasSubstr("no_such_kind"));
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
  for (const std::string& kind : JobKinds()) {
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

/// Ports of what a job of this kind brings.
std::vector<PortInfo> JobPorts(const std::string& kind) {
  if (kind == DenseJob::kKind) return PortsOf<DenseJob>();
  return kind == SparseJob::kKind ? PortsOf<SparseJob>() : PortsOf<SparseFromMatchesJob>();
}

/// The outputs of a stage that tasks list: all but recipes.
std::vector<PortInfo> OutputsOf(const Stage& stage) {
  std::vector<PortInfo> outputs = stage.outputs;
  std::erase_if(outputs, [](const PortInfo& port) { return port.kind == Kind::kRecipe; });
  return outputs;
}

std::vector<std::string_view> TypesLeft(const std::string& kind,
                                        const StageRule& reader,
                                        const InputRule& rule) {
  if (rule.kind == Kind::kJobInput) return JobPorts(kind).at(rule.index).types;
  if (rule.kind == Kind::kRecipe && reader.parts_listed_in)
    return JobPorts(kind).at(*reader.parts_listed_in).types;
  const Stage* from =
      FindStage(rule.kind == Kind::kRecipe ? reader.parts_from : rule.stage).value();
  if (rule.kind == Kind::kRecipe) {
    const auto recipes = std::ranges::find(from->outputs, Kind::kRecipe, &PortInfo::kind);
    return recipes == from->outputs.end() ? std::vector<std::string_view>{} : recipes->types;
  }
  const std::vector<PortInfo> outputs = OutputsOf(*from);
  if (rule.kind != Kind::kAllOutputs) return outputs.at(rule.index).types;
  std::vector<std::string_view> types;
  for (const PortInfo& output : outputs) types.push_back(output.types.front());
  return types;
}

/// Plans are data for the coordinator; this holds the data against what stages state of themselves.
TEST(FindJobPlan, StatesOfEveryStageWhatTheRegistryDoes) {
  for (const std::string& kind : JobKinds()) {
    const auto plan = FindJobPlan(kind);
    ASSERT_TRUE(plan.ok());
    for (const StageRule& rule : plan->stages) {
      const auto stage = FindStage(rule.stage);
      ASSERT_TRUE(stage.ok()) << stage.status();
      EXPECT_EQ(rule.version, (*stage)->facts.version);
      EXPECT_EQ(rule.weight, (*stage)->facts.weight);
      EXPECT_EQ(rule.needs.memory_bytes, (*stage)->facts.needs.memory_bytes);
      EXPECT_EQ(rule.option_sections, (*stage)->option_sections);
      ASSERT_EQ(rule.inputs.size(), (*stage)->inputs.size()) << rule.stage;
      for (size_t i = 0; i < rule.inputs.size(); ++i) {
        const PortInfo& port = (*stage)->inputs[i];
        EXPECT_EQ(TypesLeft(kind, rule, rule.inputs[i]), port.types)
            << rule.stage << " " << port.name;
        const bool is_from_job = rule.inputs[i].kind == Kind::kJobInput;
        if (is_from_job) continue;
        EXPECT_EQ(rule.inputs[i].kind, port.kind) << rule.stage << " " << port.name;
      }
    }
  }
}

/// One value is read of a stage with one part, a list of one that has parts.
TEST(FindJobPlan, ReadsListsOfStagesWithPartsAndSingleValuesOfOthers) {
  for (const std::string& kind : JobKinds()) {
    const auto plan = FindJobPlan(kind);
    ASSERT_TRUE(plan.ok());
    for (const StageRule& rule : plan->stages) {
      for (const InputRule& input : rule.inputs) {
        if (input.kind == Kind::kJobInput || input.kind == Kind::kRecipe) continue;
        const auto from = std::ranges::find(plan->stages, input.stage, &StageRule::stage);
        ASSERT_NE(from, plan->stages.end()) << input.stage;
        EXPECT_EQ(from->HasOnePart(), input.kind == Kind::kOutput) << rule.stage;
      }
    }
  }
}

TEST(FindJobPlan, LeavesNoStageOfTheRegistryOut) {
  std::vector<std::string> planned;
  for (const std::string& kind : JobKinds()) {
    const JobPlan plan = FindJobPlan(kind).value();
    for (const StageRule& rule : plan.stages) planned.push_back(rule.stage);
  }
  for (const Stage& stage : AllStages())
    EXPECT_THAT(planned, ::testing::Contains(std::string(stage.facts.name)));
}

}  // namespace
}  // namespace orbweave
