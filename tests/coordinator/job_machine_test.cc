// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/job_machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

/// One stage after the other, without inputs.
JobPlan LinePlan(const std::vector<std::string>& stages) {
  JobPlan plan{.kind = "line"};
  for (const std::string& stage : stages) plan.stages.push_back({.stage = stage});
  return plan;
}

JobMachine MachineFor(const std::vector<std::string>& stages) {
  return {{.kind = "line", .label = "test"},
          LinePlan(stages),
          {.max_attempts = 3, .first_wait_s = 1.0},
          100.0};
}

/// `count` tasks of a stage, told apart by their input.
std::vector<TaskSpec> Tasks(const std::string& stage, uint32_t count) {
  std::vector<TaskSpec> tasks;
  for (uint32_t part = 0; part < count; ++part) {
    tasks.push_back({.stage = stage, .inputs = {DigestOf(std::to_string(part))}, .part = part});
  }
  return tasks;
}

void Begin(JobMachine& machine, const std::string& stage, uint32_t count, double now_s = 100.0) {
  machine.StageBegins(Tasks(stage, count), std::vector<std::optional<TaskResult>>(count), now_s);
}

/// Leases what comes next to `worker`.
TaskRef LeaseNext(JobMachine& machine,
                  const std::string& worker,
                  double now_s,
                  uint64_t epoch = 1) {
  const std::optional<TaskRef> ref = machine.NextReady(worker, {worker}, now_s);
  ORBWEAVE_CHECK(ref.has_value());
  machine.TaskLeased(*ref, {.epoch = epoch, .worker = worker}, now_s);
  return *ref;
}

TEST(JobMachine, StartsAStageWhenTheOneBeforeIsDone) {
  JobMachine machine = MachineFor({"a", "b"});
  EXPECT_EQ(machine.StageToPlan(), 0U);
  Begin(machine, "a", 2);
  EXPECT_EQ(machine.StageToPlan(), std::nullopt);
  const TaskRef first = LeaseNext(machine, "w", 101.0);
  const TaskRef second = LeaseNext(machine, "w", 101.0);
  EXPECT_EQ(second, (TaskRef{0, 1}));
  EXPECT_EQ(machine.NextReady("w", {"w"}, 101.0), std::nullopt);
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
    Begin(machine, "decide", 1);
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
  Begin(machine, "decide", 1);
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
    Begin(machine, "work", 1);
    machine.TaskDone(LeaseNext(machine, "w", 100.0), {}, 101.0);
    ASSERT_EQ(machine.StageToPlan(), 1U);
    Begin(machine, "review", 1);
    machine.TaskDone(LeaseNext(machine, "w", 100.0), {.recipes = {DigestOf("more")}}, 101.0);
  }
  machine.StageBegins(Tasks("work", 1), {TaskResult{}}, 102.0);
  machine.StageBegins(Tasks("review", 1), {TaskResult{}}, 102.0);
  EXPECT_EQ(machine.StageToPlan(), 2U) << "found results count like computed ones";
  EXPECT_EQ(machine.Status(102.0).stages[0].tasks_total, 3U);
}

/// A loop's stage `work` of four parts of which w1 did the first two the last time, w2 the others.
JobMachine SecondRound() {
  JobPlan plan = LinePlan({"work", "review", "end"});
  plan.stages[1].back_to = "work";
  JobMachine machine({.kind = "line"}, plan, {.first_wait_s = 1.0}, 100.0);
  Begin(machine, "work", 4);
  for (const char* worker : {"w1", "w1", "w2", "w2"})
    machine.TaskDone(LeaseNext(machine, worker, 100.0), {}, 101.0);
  Begin(machine, "review", 1);
  machine.TaskDone(LeaseNext(machine, "w1", 101.0), {.recipes = {DigestOf("more")}}, 102.0);
  Begin(machine, "work", 4);
  return machine;
}

TEST(JobMachine, GivesTheNextRoundOfAPartToWhomHadTheLast) {
  JobMachine machine = SecondRound();
  const auto next = [&machine](const std::string& worker, const std::vector<std::string>& alive) {
    const TaskRef ref = *machine.NextReady(worker, alive, 102.0);
    machine.TaskLeased(ref, {.epoch = 9, .worker = worker}, 102.0);
    return ref.part;
  };
  EXPECT_EQ(next("w2", {"w1", "w2"}), 2U);
  EXPECT_EQ(next("w1", {"w1", "w2"}), 0U);
  EXPECT_EQ(next("w2", {"w1", "w2"}), 3U);
  EXPECT_EQ(next("w2", {"w1", "w2"}), 1U) << "rather another's than none";
}

TEST(JobMachine, GivesPartsOfWorkersThatAreGoneBeforeThoseOfOthers) {
  const JobMachine machine = SecondRound();
  EXPECT_EQ(machine.NextReady("w3", {"w1", "w3"}, 102.0)->part, 2U);
  EXPECT_EQ(machine.NextReady("w3", {"w1", "w2", "w3"}, 102.0)->part, 3U);
  EXPECT_EQ(machine.NextReady("w3", {"w3"}, 102.0)->part, 0U);
}

TEST(JobMachine, DoesNotGiveOutWhatWasFound) {
  JobMachine machine = MachineFor({"a"});
  const TaskResult found{.cost = {.cpu_s = 7.0}};
  machine.StageBegins(Tasks("a", 3), {TaskResult{}, std::nullopt, found}, 100.0);
  EXPECT_EQ(machine.NextReady("w", {"w"}, 100.0), (TaskRef{0, 1}));
  const StageStatus stage = machine.Status(100.0).stages[0];
  EXPECT_EQ(stage.tasks_total, 3U);
  EXPECT_EQ(stage.tasks_done, 2U);
  EXPECT_EQ(stage.tasks_reused, 2U);
  ASSERT_EQ(machine.Costs().size(), 2U);
  EXPECT_EQ(machine.Costs()[1].part, 2U);
  EXPECT_DOUBLE_EQ(machine.Costs()[1].cost.cpu_s, 7.0) << "as when it was computed";
}

TEST(JobMachine, RetriesATransientFailureAfterAWait) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  machine.TaskFailed(LeaseNext(machine, "w", 100.0), absl::UnavailableError("gone"), 100.0);
  EXPECT_EQ(machine.NextReady("w", {"w"}, 100.5), std::nullopt);
  EXPECT_EQ(machine.NextReady("w", {"w"}, 101.0), (TaskRef{0, 0}));
  EXPECT_EQ(machine.Status(101.0).stages[0].retries, 1U);
}

TEST(JobMachine, PrefersAWorkerThatHasNotFailedTheTask) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  machine.TaskFailed(LeaseNext(machine, "w1", 100.0), absl::InternalError("crash"), 100.0);
  EXPECT_EQ(machine.NextReady("w1", {"w1", "w2"}, 200.0), std::nullopt);
  EXPECT_EQ(machine.NextReady("w2", {"w1", "w2"}, 200.0), (TaskRef{0, 0}));
  EXPECT_EQ(machine.NextReady("w1", {"w1"}, 200.0), (TaskRef{0, 0}));
}

TEST(JobMachine, FailsAfterTheLastAttemptAndSaysWhatAndWhy) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 2);
  for (int attempt = 0; attempt < 3; ++attempt) {
    ASSERT_EQ(machine.state(), JobState::kRunning);
    machine.TaskFailed(LeaseNext(machine, "w", 1000.0 * attempt + 100.0),
                       absl::InternalError("segfault"),
                       1000.0 * attempt + 100.0);
  }
  EXPECT_EQ(machine.state(), JobState::kFailed);
  EXPECT_THAT(machine.error(), HasSubstr("stage a, part 0"));
  EXPECT_THAT(machine.error(), HasSubstr("failed 3 times"));
  EXPECT_THAT(machine.error(), HasSubstr("segfault"));
  EXPECT_EQ(machine.NextReady("w", {"w"}, 9000.0), std::nullopt);
}

TEST(JobMachine, FailsAtOnceWhenAnErrorIsPermanent) {
  for (const absl::Status& error : {absl::InvalidArgumentError("no images"),
                                    absl::FailedPreconditionError("no images"),
                                    absl::OutOfRangeError("no images")}) {
    JobMachine machine = MachineFor({"a"});
    Begin(machine, "a", 1);
    machine.TaskFailed(LeaseNext(machine, "w", 100.0), error, 100.0);
    EXPECT_EQ(machine.state(), JobState::kFailed);
    EXPECT_THAT(machine.error(), HasSubstr("no images"));
  }
}

TEST(JobMachine, AReturnedTaskIsReadyAtOnceAndDoesNotCount) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  for (int i = 0; i < 10; ++i) {
    machine.TaskFailed(LeaseNext(machine, "w", 100.0), absl::CancelledError("shutdown"), 100.0);
  }
  EXPECT_EQ(machine.state(), JobState::kRunning);
  EXPECT_EQ(machine.Status(100.0).stages[0].retries, 0U);
}

TEST(JobMachine, CancellingEndsItAndLateEventsChangeNothing) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  const TaskRef ref = LeaseNext(machine, "w", 100.0);
  machine.JobIsCancelled(101.0);
  machine.TaskDone(ref, {}, 102.0);
  EXPECT_EQ(machine.state(), JobState::kCancelled);
  EXPECT_EQ(machine.Status(102.0).stages[0].tasks_done, 0U);
}

TEST(JobMachine, KnowsWhichAttemptWasTaken) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  const TaskRef ref = LeaseNext(machine, "w", 100.0, 7);
  const Digest id = machine.TaskId(ref);
  EXPECT_FALSE(machine.WasDoneBy(id, 7));
  machine.TaskDone(ref, {}, 101.0);
  EXPECT_TRUE(machine.WasDoneBy(id, 7));
  EXPECT_FALSE(machine.WasDoneBy(id, 8));
}

TEST(JobMachine, ReportsOutcomesInOrderAndTimingsAsTheyEnd) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 2);
  const TaskRef first = LeaseNext(machine, "w1", 101.0);
  const TaskRef second = LeaseNext(machine, "w2", 102.0);
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
