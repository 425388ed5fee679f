// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include "tests/coordinator/line_job.h"

namespace orbweave {
namespace {

using testing::Begin;
using testing::LeaseNext;
using testing::LinePlan;
using testing::MachineFor;
using testing::Tasks;

TEST(JobMachine, StartsAStageWhenTheOneBeforeIsDone) {
  JobMachine machine = MachineFor({"a", "b"});
  EXPECT_EQ(machine.StageToPlan(), 0U);
  Begin(machine, "a", 2);
  EXPECT_EQ(machine.StageToPlan(), std::nullopt);
  const AttemptRef first = LeaseNext(machine, "w", 101.0);
  const AttemptRef second = LeaseNext(machine, "w", 101.0);
  EXPECT_EQ(second.task, (TaskRef{0, 1}));
  EXPECT_EQ(machine.NextReady({"w"}, {"w"}, 101.0), std::nullopt);
  machine.TaskDone(second, {}, 102.0);
  EXPECT_EQ(machine.StageToPlan(), std::nullopt);
  machine.TaskDone(first, {}, 103.0);
  EXPECT_EQ(machine.StageToPlan(), 1U);
  Begin(machine, "b", 1);
  machine.TaskDone(LeaseNext(machine, "w", 104.0), {}, 105.0);
  EXPECT_EQ(machine.state(), JobState::kDone);
  EXPECT_DOUBLE_EQ(machine.Status(999.0).elapsed_s, 5.0);
}

TEST(JobMachine, AStageWithoutTasksIsDone) {
  JobMachine machine = MachineFor({"a", "b"});
  Begin(machine, "a", 0);
  EXPECT_EQ(machine.StageToPlan(), 1U);
  Begin(machine, "b", 0);
  EXPECT_EQ(machine.state(), JobState::kDone);
}

TEST(JobMachine, RepeatsTheStagesOfALoopUntilOneHasNoTasks) {
  JobPlan plan = LinePlan({"start", "decide", "work", "end"});
  plan.stages[2].parts_from = "decide";
  plan.stages[2].back_to = "decide";
  JobMachine machine({.kind = "line"}, plan, {}, 100.0);
  Begin(machine, "start", 0);
  for (uint32_t round = 0; round < 3; ++round) {
    ASSERT_EQ(machine.StageToPlan(), 1U);
    Begin(machine, "decide", 1, 100.0, round);
    machine.TaskDone(LeaseNext(machine, "w", 100.0), {.cost = {.cpu_s = 1.0}}, 101.0);
    ASSERT_EQ(machine.StageToPlan(), 2U);
    Begin(machine, "work", 2);
    for (int part = 0; part < 2; ++part) {
      const Digest output = DigestOf(std::to_string(10 * round));
      machine.TaskDone(LeaseNext(machine, "w", 100.0), {.outputs = {output}}, 101.0);
    }
  }
  EXPECT_EQ(machine.results()[2].size(), 2U);
  EXPECT_EQ(machine.results()[2][1].outputs[0], DigestOf("20")) << "of the last round";
  Begin(machine, "decide", 1, 100.0, 3);
  machine.TaskDone(LeaseNext(machine, "w", 100.0), {.cost = {.cpu_s = 1.0}}, 101.0);
  Begin(machine, "work", 0);
  EXPECT_EQ(machine.StageToPlan(), 3U);
  const JobStatus status = machine.Status(102.0);
  EXPECT_EQ(status.stages[1].tasks_done, 4U);
  EXPECT_DOUBLE_EQ(status.stages[1].cpu_s, 4.0);
  EXPECT_EQ(status.stages[2].tasks_total, 6U);
  EXPECT_EQ(machine.Outcomes().size(), 1U) << "the last round of each stage";
  const std::vector<MeasuredTask> costs = machine.Costs();
  ASSERT_EQ(costs.size(), 10U) << "of every round";
  EXPECT_EQ(costs[3].stage, "decide");
  EXPECT_EQ(costs[3].run, 3U);
  EXPECT_DOUBLE_EQ(costs[3].cost.cpu_s, 1.0);
  EXPECT_EQ(costs[5].run, 4U);
  EXPECT_EQ(costs[5].part, 1U);
  EXPECT_EQ(machine.Timings()[3].run, 3U);
  Begin(machine, "end", 0);
  EXPECT_EQ(machine.state(), JobState::kDone);
}

TEST(JobMachine, RepeatsALoopWhoseEndHasOnePartAsLongAsThatLeavesARecipe) {
  JobPlan plan = LinePlan({"work", "review", "end"});
  plan.stages[1].back_to = "work";
  JobMachine machine({.kind = "line"}, plan, {}, 100.0);
  for (uint32_t round = 0; round < 2; ++round) {
    ASSERT_EQ(machine.StageToPlan(), 0U);
    Begin(machine, "work", 1, 100.0, round);
    machine.TaskDone(LeaseNext(machine, "w", 100.0), {}, 101.0);
    ASSERT_EQ(machine.StageToPlan(), 1U);
    Begin(machine, "review", 1);
    machine.TaskDone(LeaseNext(machine, "w", 100.0), {.recipes = {DigestOf("more")}}, 101.0);
  }
  machine.StageBegins(Tasks("work", 1, 2), {TaskResult{}}, 102.0);
  machine.StageBegins(Tasks("review", 1), {TaskResult{}}, 102.0);
  EXPECT_EQ(machine.StageToPlan(), 2U) << "found results count like computed ones";
  EXPECT_EQ(machine.Status(102.0).stages[0].tasks_total, 3U);
}

TEST(JobMachine, FailsWhenARoundOfALoopIsAnEarlierOneAgain) {
  JobPlan plan = LinePlan({"work", "review"});
  plan.stages[1].back_to = "work";
  JobMachine machine({.kind = "line"}, plan, {}, 100.0);
  const std::optional<TaskResult> once_more = TaskResult{.recipes = {DigestOf("more")}};
  for (const uint32_t round : {0U, 1U}) {
    machine.StageBegins(Tasks("work", 1, round), {TaskResult{}}, 101.0);
    machine.StageBegins(Tasks("review", 1), {once_more}, 101.0);
    ASSERT_EQ(machine.state(), JobState::kRunning);
  }
  machine.StageBegins(Tasks("work", 1, 0), {TaskResult{}}, 102.0);
  EXPECT_EQ(machine.state(), JobState::kFailed);
  EXPECT_NE(machine.error().find("from work to review"), std::string::npos) << machine.error();
}

TEST(JobMachine, FailsAfterAsManyRoundsAsItsPlanAllows) {
  JobPlan plan = LinePlan({"work", "review"});
  plan.stages[1].back_to = "work";
  plan.stages[1].max_rounds = 3;
  JobMachine machine({.kind = "line"}, plan, {}, 100.0);
  const std::optional<TaskResult> once_more = TaskResult{.recipes = {DigestOf("more")}};
  for (uint32_t round = 0; round < 3; ++round) {
    machine.StageBegins(Tasks("work", 1, round), {TaskResult{}}, 101.0);
    machine.StageBegins(Tasks("review", 1), {once_more}, 101.0);
    ASSERT_EQ(machine.state(), JobState::kRunning);
  }
  Begin(machine, "work", 1, 102.0, 3);
  EXPECT_EQ(machine.state(), JobState::kFailed);
  EXPECT_NE(machine.error().find("after 3 rounds"), std::string::npos) << machine.error();
}

TEST(JobMachine, DoesNotGiveOutWhatWasFound) {
  JobMachine machine = MachineFor({"a"});
  const TaskResult found{.cost = {.cpu_s = 7.0}};
  machine.StageBegins(Tasks("a", 3), {TaskResult{}, std::nullopt, found}, 100.0);
  EXPECT_EQ(machine.NextReady({"w"}, {"w"}, 100.0), (TaskRef{0, 1}));
  const StageStatus stage = machine.Status(100.0).stages[0];
  EXPECT_EQ(stage.tasks_total, 3U);
  EXPECT_EQ(stage.tasks_done, 2U);
  EXPECT_EQ(stage.tasks_reused, 2U);
  ASSERT_EQ(machine.Costs().size(), 2U);
  EXPECT_EQ(machine.Costs()[1].part, 2U);
  EXPECT_DOUBLE_EQ(machine.Costs()[1].cost.cpu_s, 7.0) << "as when it was computed";
}

TEST(JobMachine, CountsWhatALaterRoundFindsOfAnEarlierOnce) {
  JobPlan plan = LinePlan({"decide", "work", "end"});
  plan.stages[1].parts_from = "decide";
  plan.stages[1].back_to = "decide";
  JobMachine machine({.kind = "line"}, plan, {}, 100.0);
  Begin(machine, "decide", 1, 100.0, 0);
  machine.TaskDone(LeaseNext(machine, "w", 100.0), {}, 101.0);
  Begin(machine, "work", 1);
  const TaskResult result{.cost = {.cpu_s = 5.0}};
  machine.TaskDone(LeaseNext(machine, "w", 101.0), result, 106.0);
  Begin(machine, "decide", 1, 106.0, 1);
  machine.TaskDone(LeaseNext(machine, "w", 106.0), {}, 107.0);
  machine.StageBegins(Tasks("work", 2), {result, std::nullopt}, 107.0);
  const StageStatus half = machine.Status(107.0).stages[1];
  EXPECT_EQ(half.tasks_total, 2U);
  EXPECT_EQ(half.tasks_done, 1U);
  EXPECT_EQ(half.tasks_reused, 0U) << "nothing was there before the job";
  machine.TaskDone(LeaseNext(machine, "w", 107.0), result, 112.0);
  EXPECT_EQ(machine.Costs().size(), 4U) << "two decisions, two works";
}

TEST(JobMachine, CancellingEndsItAndLateEventsChangeNothing) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  const AttemptRef ref = LeaseNext(machine, "w", 100.0);
  machine.JobIsCancelled(101.0);
  machine.TaskDone(ref, {}, 102.0);
  EXPECT_EQ(machine.state(), JobState::kCancelled);
  EXPECT_EQ(machine.Status(102.0).stages[0].tasks_done, 0U);
}

TEST(JobMachine, KnowsWhichAttemptWasTaken) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  const AttemptRef ref = LeaseNext(machine, "w", 100.0, 7);
  const Digest id = machine.TaskId(ref.task);
  EXPECT_FALSE(machine.WasDoneBy(id, 7));
  machine.TaskDone(ref, {}, 101.0);
  EXPECT_TRUE(machine.WasDoneBy(id, 7));
  EXPECT_FALSE(machine.WasDoneBy(id, 8));
}

TEST(JobMachine, ReportsOutcomesInOrderAndTimingsAsTheyEnd) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 2);
  const AttemptRef first = LeaseNext(machine, "w1", 101.0);
  const AttemptRef second = LeaseNext(machine, "w2", 102.0);
  machine.TaskProgressed(first, {1, 4, "images"});
  EXPECT_DOUBLE_EQ(machine.Status(102.0).stages[0].fraction_running, 0.25);
  machine.TaskDone(second, {.report_json = "second", .cost = {.cpu_s = 2.0}}, 103.0);
  machine.TaskDone(first, {.report_json = "first", .cost = {.cpu_s = 3.0}}, 105.0);
  const std::vector<TaskOutcome> outcomes = machine.Outcomes();
  ASSERT_EQ(outcomes.size(), 2U);
  EXPECT_EQ(outcomes[0].result.report_json, "first");
  EXPECT_EQ(outcomes[1].result.report_json, "second");
  ASSERT_EQ(machine.Timings().size(), 2U);
  EXPECT_EQ(machine.Timings()[0].worker, "w2");
  EXPECT_DOUBLE_EQ(machine.Timings()[1].start_s, 1.0);
  EXPECT_DOUBLE_EQ(machine.Timings()[1].end_s, 5.0);
  const StageStatus stage = machine.Status(105.0).stages[0];
  EXPECT_DOUBLE_EQ(stage.wall_s, 4.0);
  EXPECT_DOUBLE_EQ(stage.cpu_s, 5.0);
}

}  // namespace
}  // namespace orbweave
