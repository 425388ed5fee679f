// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/job_machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

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
          {.max_transient = 3, .max_infrastructure = 4, .max_process_lost = 2, .first_wait_s = 1.0},
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
AttemptRef LeaseNext(JobMachine& machine,
                     const std::string& worker,
                     double now_s,
                     uint64_t epoch = 1) {
  const std::optional<TaskRef> ref = machine.NextReady({worker}, {worker}, now_s);
  ORBWEAVE_CHECK(ref.has_value());
  machine.TaskLeased(*ref, {.epoch = epoch, .worker = worker}, now_s);
  return {*ref, epoch};
}

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
    const TaskRef ref = *machine.NextReady({worker}, alive, 102.0);
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
  EXPECT_EQ(machine.NextReady({"w3"}, {"w1", "w3"}, 102.0)->part, 2U);
  EXPECT_EQ(machine.NextReady({"w3"}, {"w1", "w2", "w3"}, 102.0)->part, 3U);
  EXPECT_EQ(machine.NextReady({"w3"}, {"w3"}, 102.0)->part, 0U);
}

TEST(JobMachine, TellsTheSlotsOfAWorkerApart) {
  const JobMachine machine = SecondRound();
  EXPECT_EQ(machine.NextReady({"w2", 0}, {"w1", "w2"}, 102.0)->part, 2U);
  EXPECT_EQ(machine.NextReady({"w2", 1}, {"w2"}, 102.0)->part, 0U) << "whose worker is gone";
}

TEST(JobMachine, OnlyQuickTasksWaitBehindAnother) {
  for (const double wall_s : {0.1, 1.0}) {
    JobMachine machine = MachineFor({"a"});
    Begin(machine, "a", 4);
    const AttemptRef first = LeaseNext(machine, "w", 100.0);
    EXPECT_EQ(machine.NextReady({"w"}, {"w"}, 100.0, true), std::nullopt) << "who knows how long";
    machine.TaskDone(first, {.cost = {.wall_s = wall_s}}, 101.0);
    EXPECT_EQ(machine.NextReady({"w"}, {"w"}, 101.0, true).has_value(), wall_s < 0.2);
    const AttemptRef failed = LeaseNext(machine, "w", 101.0);
    machine.TaskFailed(failed, absl::AbortedError("signal 11"), 102.0);
    for (int rest = 0; rest < 2; ++rest) {
      const TaskRef other = *machine.NextReady({"w"}, {"v", "w"}, 102.0);
      machine.TaskLeased(other, {.epoch = 9, .worker = "w"}, 102.0);
    }
    EXPECT_EQ(machine.NextReady({"w"}, {"w"}, 200.0, true), std::nullopt) << "it failed before";
    EXPECT_EQ(machine.NextReady({"w"}, {"w"}, 200.0), failed.task);
  }
}

TEST(JobMachine, WhatIsAtHomeElsewhereDoesNotWait) {
  JobMachine machine = SecondRound();
  const std::vector<std::string> alive = {"w1", "w2"};
  for (const uint32_t own : {2U, 3U}) {
    const std::optional<TaskRef> ref = machine.NextReady({"w2"}, alive, 102.0, true);
    ASSERT_TRUE(ref.has_value());
    EXPECT_EQ(ref->part, own);
    machine.TaskLeased(*ref, {.epoch = 9, .worker = "w2"}, 102.0);
  }
  EXPECT_EQ(machine.NextReady({"w2"}, alive, 102.0, true), std::nullopt);
  EXPECT_EQ(machine.NextReady({"w2"}, alive, 102.0)->part, 1U);
}

TEST(JobMachine, TheTimeThatATaskWaitsBehindAnotherIsNotItsOwn) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 2);
  const AttemptRef first = LeaseNext(machine, "w", 101.0);
  const AttemptRef second = LeaseNext(machine, "w", 101.0);
  machine.TaskDone(first, {}, 103.0);
  machine.TaskDone(second, {}, 106.0);
  ASSERT_EQ(machine.Timings().size(), 2U);
  EXPECT_EQ(machine.Timings()[0].start_s, 1.0);
  EXPECT_EQ(machine.Timings()[1].start_s, machine.Timings()[0].end_s);
  EXPECT_EQ(machine.Timings()[1].end_s, 6.0);
}

TEST(JobMachine, GivesWorkersNeighbouringParts) {
  constexpr uint32_t kParts = 1000;
  const std::vector<std::string> workers = {"w1", "w2", "w3", "w4", "w5"};
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", kParts);
  std::map<std::string, uint32_t> last;
  std::set<uint32_t> given;
  uint32_t jumps = 0;
  for (uint32_t turn = 0; turn < kParts; ++turn) {
    const std::string& worker = workers[turn % workers.size()];
    const TaskRef ref = *machine.NextReady({worker}, workers, 100.0);
    machine.TaskLeased(ref, {.epoch = turn, .worker = worker}, 100.0);
    if (last.contains(worker) && ref.part != last[worker] + 1) ++jumps;
    last[worker] = ref.part;
    given.insert(ref.part);
    if (turn >= workers.size()) continue;  // the others stay with their workers
    machine.TaskDone({ref, turn}, {}, 101.0);
  }
  EXPECT_EQ(given.size(), kParts);
  EXPECT_LT(jumps, 60U) << "one after the other they would have jumped every time";
}

TEST(JobMachine, AWorkerBeginsWhereNobodyWorksTowards) {
  const std::vector<std::string> alive = {"w1", "w2"};
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 100);
  const auto lease = [&](const std::string& worker, uint64_t epoch) {
    const TaskRef ref = *machine.NextReady({worker}, alive, 100.0);
    machine.TaskLeased(ref, {.epoch = epoch, .worker = worker}, 100.0);
    return ref;
  };
  const TaskRef first = lease("w1", 1);
  EXPECT_EQ(first.part, 0U);
  const TaskRef middle = lease("w2", 2);
  EXPECT_EQ(middle.part, 50U);
  machine.TaskFailed({first, 1}, absl::CancelledError("it left"), 101.0);
  EXPECT_EQ(machine.NextReady({"w3"}, {"w2", "w3"}, 101.0)->part, 0U) << "w1 works no more";
  EXPECT_EQ(machine.NextReady({"w2"}, {"w2", "w3"}, 101.0)->part, 51U);
}

TEST(JobMachine, RemembersFailuresOfBeforeARestart) {
  JobMachine machine = MachineFor({"a"});
  const std::vector<TaskSpec> tasks = Tasks("a", 2);
  const FailedAttempt crash{tasks[0].Id(), "w", absl::StatusCode::kAborted, "signal 11"};
  machine.Remember({crash});
  Begin(machine, "a", 2);
  EXPECT_EQ(machine.Status(100.0).stages[0].retries, 1U);
  EXPECT_THAT(machine.FailedOn({0, 0}), ::testing::ElementsAre("w"));
  EXPECT_EQ(machine.NextReady({"w"}, {"other", "w"}, 200.0)->part, 1U) << "another worker first";
  const AttemptRef again = LeaseNext(machine, "other", 200.0);
  ASSERT_EQ(again.task.part, 0U);
  machine.TaskFailed(again, absl::AbortedError("signal 11"), 200.0);
  EXPECT_EQ(machine.state(), JobState::kFailed) << "two are too many";
  EXPECT_THAT(machine.error(), HasSubstr("lost its process 2 times, last on other"));
}

TEST(JobMachine, FailsWhereTheRestartCameBeforeItWasSaid) {
  JobMachine machine = MachineFor({"a"});
  const FailedAttempt crash{Tasks("a", 1)[0].Id(), "w", absl::StatusCode::kAborted, "signal 11"};
  machine.Remember({crash, crash});
  Begin(machine, "a", 1);
  EXPECT_EQ(machine.state(), JobState::kFailed);
  EXPECT_THAT(machine.error(),
              HasSubstr("lost its process 2 times, last on w: ABORTED: signal 11"));
}

TEST(JobMachine, FailuresOfTasksThatAreDoneCountForTheJobAlone) {
  JobMachine machine = MachineFor({"a"});
  const FailedAttempt crash{Tasks("a", 1)[0].Id(), "w", absl::StatusCode::kAborted, "signal 11"};
  machine.Remember({crash, crash});
  machine.StageBegins(Tasks("a", 2), {TaskResult{}, std::nullopt}, 100.0);
  EXPECT_EQ(machine.state(), JobState::kRunning);
  EXPECT_EQ(machine.Status(100.0).stages[0].retries, 2U);
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

TEST(JobMachine, RetriesATransientFailureAfterAWait) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  machine.TaskFailed(LeaseNext(machine, "w", 100.0), absl::UnavailableError("gone"), 100.0);
  EXPECT_EQ(machine.NextReady({"w"}, {"w"}, 100.4), std::nullopt);
  EXPECT_EQ(machine.NextReady({"w"}, {"w"}, 101.0), (TaskRef{0, 0}));
  EXPECT_EQ(machine.Status(101.0).stages[0].retries, 1U);
}

TEST(JobMachine, PrefersAWorkerThatHasNotFailedTheTask) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  machine.TaskFailed(LeaseNext(machine, "w1", 100.0), absl::InternalError("crash"), 100.0);
  EXPECT_EQ(machine.NextReady({"w1"}, {"w1", "w2"}, 200.0), std::nullopt);
  EXPECT_EQ(machine.NextReady({"w2"}, {"w1", "w2"}, 200.0), (TaskRef{0, 0}));
  EXPECT_EQ(machine.NextReady({"w1"}, {"w1"}, 200.0), (TaskRef{0, 0}));
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
  EXPECT_EQ(machine.NextReady({"w"}, {"w"}, 9000.0), std::nullopt);
}

TEST(JobMachine, CountsFailuresByTheirClass) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  double now_s = 100.0;
  const auto fail = [&](const absl::Status& error) {
    machine.TaskFailed(LeaseNext(machine, "w", now_s), error, now_s);
    now_s += 100.0;
  };
  for (int i = 0; i < 3; ++i) fail(absl::UnavailableError("went silent"));
  for (int i = 0; i < 2; ++i) fail(absl::InternalError("no luck"));
  fail(absl::AbortedError("signal 9"));
  EXPECT_EQ(machine.state(), JobState::kRunning) << machine.error();
  fail(absl::ResourceExhaustedError("out of memory"));
  EXPECT_EQ(machine.state(), JobState::kFailed);
  EXPECT_THAT(machine.error(), HasSubstr("failed 4 times"));
}

TEST(JobMachine, NamesTheInputsOfATaskThatKillsItsProcesses) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  machine.TaskFailed(LeaseNext(machine, "w1", 100.0), absl::AbortedError("signal 11"), 100.0);
  machine.TaskFailed(LeaseNext(machine, "w2", 200.0), absl::DeadlineExceededError("hung"), 200.0);
  EXPECT_EQ(machine.state(), JobState::kFailed);
  EXPECT_THAT(machine.error(), HasSubstr("stage a, part 0"));
  EXPECT_THAT(machine.error(), HasSubstr("lost its process 2 times, last on w2"));
  EXPECT_THAT(machine.error(), HasSubstr("its inputs: " + DigestOf("0").ToShortHex()));
}

TEST(JobMachine, GivesUpWhenTooMuchOfItFails) {
  constexpr uint32_t kTasks = 20;
  JobMachine machine({.kind = "line"},
                     LinePlan({"a"}),
                     {.job_retries = 4, .job_retry_share = 0.1, .first_wait_s = 1.0},
                     100.0);
  Begin(machine, "a", kTasks);
  for (int failures = 0; failures < 7; ++failures) {
    ASSERT_EQ(machine.state(), JobState::kRunning) << failures;
    machine.TaskFailed(LeaseNext(machine, "w", 100.0), absl::UnavailableError("no store"), 100.0);
  }
  EXPECT_EQ(machine.state(), JobState::kFailed);
  EXPECT_THAT(machine.error(), HasSubstr("gave up after 7 failed attempts at 20 tasks"));
}

/// A stage of `count` tasks of which all but the last `left` were done in 40 s each; those left
/// began at 100 s on the worker "slow", under epochs from 1000 on.
JobMachine MachineWithStragglers(uint32_t count, uint32_t left) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", count);
  for (uint32_t part = 0; part < count; ++part) {
    const bool is_left = part + left >= count;
    const AttemptRef ref = LeaseNext(machine, is_left ? "slow" : "w", 100.0, 1000 + part);
    if (!is_left) machine.TaskDone(ref, {}, 140.0);
  }
  return machine;
}

TEST(JobMachine, LetsAnIdleWorkerRepeatAStraggler) {
  JobMachine machine = MachineWithStragglers(3, 1);
  const AttemptRef slow{{0, 2}, 1002};
  EXPECT_EQ(machine.NextStraggler("w", 8, 180.0), std::nullopt) << "twice the median";
  EXPECT_EQ(machine.NextStraggler("slow", 8, 181.0), std::nullopt) << "does it itself";
  ASSERT_EQ(machine.NextStraggler("w", 8, 181.0), slow.task);
  machine.TaskLeased(slow.task, {.epoch = 7, .worker = "w"}, 181.0);
  EXPECT_EQ(machine.NextStraggler("third", 8, 999.0), std::nullopt) << "one more is enough";
  EXPECT_EQ(machine.Status(181.0).stages[0].tasks_running, 1U);
  machine.TaskDone({slow.task, 7}, {.report_json = "quick"}, 190.0);
  EXPECT_EQ(machine.state(), JobState::kDone);
  EXPECT_TRUE(machine.WasDoneBy(machine.TaskId(slow.task), 7));
  EXPECT_FALSE(machine.WasDoneBy(machine.TaskId(slow.task), 1002));
  EXPECT_EQ(machine.Outcomes().back().result.report_json, "quick");
  ASSERT_EQ(machine.Timings().size(), 4U);
  EXPECT_FALSE(machine.Timings()[3].ok) << "the attempt that came too late";
}

TEST(JobMachine, AFailedRepetitionLeavesTheOtherAttemptAlone) {
  JobMachine machine = MachineWithStragglers(3, 1);
  const AttemptRef slow{{0, 2}, 1002};
  machine.TaskLeased(slow.task, {.epoch = 7, .worker = "w"}, 200.0);
  machine.TaskFailed({slow.task, 7}, absl::InternalError("no luck"), 201.0);
  EXPECT_EQ(machine.NextReady({"w2"}, {"w2"}, 300.0), std::nullopt);
  EXPECT_EQ(machine.Status(201.0).stages[0].tasks_running, 1U);
  machine.TaskDone(slow, {}, 210.0);
  EXPECT_EQ(machine.state(), JobState::kDone);
}

TEST(JobMachine, RepeatsNoMoreThanAShareOfTheSlots) {
  JobMachine machine = MachineWithStragglers(8, 4);
  for (const uint32_t part : {4U, 5U}) {
    ASSERT_EQ(machine.NextStraggler("w", 20, 500.0), (TaskRef{0, part}));
    machine.TaskLeased({0, part}, {.epoch = part, .worker = "w"}, 500.0);
  }
  EXPECT_EQ(machine.NextStraggler("w", 20, 500.0), std::nullopt);
  EXPECT_EQ(machine.NextStraggler("w", 30, 500.0), (TaskRef{0, 6}));
}

TEST(JobMachine, KnowsNoStragglersBeforeHalfOfTheStageIsDone) {
  JobMachine machine = MachineWithStragglers(5, 3);
  EXPECT_EQ(machine.NextStraggler("w", 100, 9999.0), std::nullopt);
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
