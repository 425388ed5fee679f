// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// A new stage, tried as CONTRIBUTING.md says: in one process, and by real worker processes, which
// are this very executable.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/commands/exec_tasks_command.h"
#include "cli/commands/work_command.h"
#include "cli/fleet/local_fleet.h"
#include "stages/job_reader.h"
#include "stages/plan_builder.h"
#include "stages/run_plan.h"
#include "tests/stages/toy/stage.h"
#include "tests/support/command.h"
#include "tests/support/command_or_tests.h"
#include "tests/support/memory_blobs.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using testing::MemoryBlobs;
using testing::TemporaryFolder;

struct ToyCountJob {
  static constexpr std::string_view kKind = "toy_count";
  One<ToyNumber> number;
  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("number", &ToyCountJob::number);
  }
};

/// The line of a plan.
JobPlan ToyCountPlan() {
  PlanBuilder plan(ToyCountJob::kKind);
  const auto job = InputsOf<ToyCountJob>();
  const auto counted = plan.Add(
      ToyCountStage{.number = job.number, .sum_before = RoundBefore(OutputsOf<ToySumStage>().sum)});
  const auto scaled = plan.Add(ToyScaleStage{.number = counted.numbers});
  plan.Add(
      ToySumStage{.scaled = scaled.scaled, .before = RoundBefore(OutputsOf<ToySumStage>().sum)});
  plan.RepeatFrom<ToyCountStage>(2.0, 10);
  return std::move(plan).Finish();
}

absl::StatusOr<JobPlan> FindToyCountPlan(std::string_view) { return ToyCountPlan(); }

/// The line of a registry.
const StageFunction* FindToyStage(std::string_view name) {
  static const auto* const kStages = new std::vector<Stage>{
      Describe<ToyCountStage>(), Describe<ToyScaleStage>(), Describe<ToySumStage>()};
  for (const Stage& stage : *kStages) {
    if (stage.facts.name == name) return &stage.run;
  }
  return nullptr;
}

JobSpec ToyCountJobOf(int64_t number, const std::string& options_text, BlobAccess& blobs) {
  return {.kind = "toy_count",
          .inputs = {PutBlob(ToyNumber{number}, blobs).value()},
          .options_text = options_text};
}

std::vector<Digest> AllOutputs(const std::vector<TaskOutcome>& outcomes) {
  std::vector<Digest> outputs;
  for (const TaskOutcome& outcome : outcomes) {
    outputs.push_back(outcome.id);
    for (const Digest& output : outcome.result.outputs) outputs.push_back(output);
  }
  return outputs;
}

// 10 (1 + 2 + 3) = 60; 60 + 10 (61 + 62 + 63) = 1920.
TEST(ToyStage, RunsInOneProcessWithItsPartsAndRounds) {
  MemoryBlobs blobs;
  const JobPlan plan = ToyCountPlan();
  const JobSpec job = ToyCountJobOf(3, "", blobs);
  const auto outcomes = RunPlan(plan, job, FindToyStage, blobs, {});
  ASSERT_TRUE(outcomes.ok()) << outcomes.status();
  EXPECT_EQ(outcomes->size(), 5U);
  JobReader reader(plan, job, *outcomes, blobs);
  EXPECT_EQ(reader.Read(&ToySumStage::Outputs::sum)->value, 1920);
  EXPECT_EQ(reader.Read(&ToyCountStage::number)->value, 3) << "by the wiring";
  const std::vector<Digest> scaled = *reader.List(&ToySumStage::scaled);
  ASSERT_EQ(scaled.size(), 3U);
  EXPECT_EQ(reader.Fetch<ToyNumber>(scaled[0])->value, 610);
}

TEST(ToyStage, ReadsItsOptionsAndRefusesOthers) {
  MemoryBlobs blobs;
  const JobPlan plan = ToyCountPlan();
  const JobSpec job = ToyCountJobOf(3, "toy.factor=1000\n", blobs);
  const auto outcomes = RunPlan(plan, job, FindToyStage, blobs, {});
  ASSERT_TRUE(outcomes.ok()) << outcomes.status();
  EXPECT_EQ(JobReader(plan, job, *outcomes, blobs).Read(&ToySumStage::Outputs::sum)->value, 6000);
  const JobSpec mistyped = ToyCountJobOf(3, "toy.faktor=2\n", blobs);
  EXPECT_THAT(RunPlan(plan, mistyped, FindToyStage, blobs, {}).status().ToString(),
              HasSubstr("toy.faktor"));
}

TEST(ToyStage, FailsByName) {
  MemoryBlobs blobs;
  const JobSpec job{.kind = "toy_count", .inputs = {*blobs.Put("no number")}};
  const auto outcomes = RunPlan(ToyCountPlan(), job, FindToyStage, blobs, {});
  EXPECT_THAT(outcomes.status().ToString(), HasSubstr("stage toy_count, part 0"));
  EXPECT_THAT(outcomes.status().ToString(), HasSubstr("'no number' is no number"));
}

TEST(ToyStage, StopsWhenAsked) {
  MemoryBlobs blobs;
  std::stop_source stop;
  stop.request_stop();
  const auto outcomes = RunPlan(
      ToyCountPlan(), ToyCountJobOf(3, "", blobs), FindToyStage, blobs, {.stop = stop.get_token()});
  EXPECT_TRUE(absl::IsCancelled(outcomes.status()));
}

TEST(ToyStage, LeavesTheSameBytesByWorkerProcesses) {
  MemoryBlobs blobs;
  const auto here = RunPlan(ToyCountPlan(), ToyCountJobOf(7, "", blobs), FindToyStage, blobs, {});
  ASSERT_TRUE(here.ok()) << here.status();
  const TemporaryFolder folder;
  const auto fleet = LocalFleet::Start(
      {.coordinator = {.state_dir = folder / "state", .find_plan = FindToyCountPlan},
       .workers = 2});
  ASSERT_TRUE(fleet.ok()) << fleet.status();
  const JobSpec job = ToyCountJobOf(7, "", (*fleet)->coordinator());
  const auto status = (*fleet)->RunJob(job, {}, {});
  ASSERT_TRUE(status.ok()) << status.status();
  ASSERT_EQ(status->state, JobState::kDone) << status->error;
  const auto there = (*fleet)->coordinator().GetOutcomes(status->id);
  ASSERT_TRUE(there.ok()) << there.status();
  EXPECT_EQ(AllOutputs(*there), AllOutputs(*here));
}

/// What `orbweave` would do with these arguments.
void AddCommands(CLI::App& app, SelectedCommand& selected) {
  static const StageLookup stages = FindToyStage;
  AddWorkCommand(app, selected);
  AddExecTasksCommand(app, selected, stages);
}

}  // namespace
}  // namespace orbweave

int main(int argc, char** argv) {
  return orbweave::testing::RunCommandOrTests(argc, argv, orbweave::AddCommands);
}
