// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/coordinator/line_job.h"

namespace orbweave {
namespace {

using testing::Begin;
using testing::LeaseNext;
using testing::LinePlan;
using testing::MachineFor;

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
  Begin(machine, "work", 4, 100.0, 1);
  return machine;
}

TEST(JobMachineLeases, GivesTheNextRoundOfAPartToWhomHadTheLast) {
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

TEST(JobMachineLeases, GivesPartsOfWorkersThatAreGoneBeforeThoseOfOthers) {
  const JobMachine machine = SecondRound();
  EXPECT_EQ(machine.NextReady({"w3"}, {"w1", "w3"}, 102.0)->part, 2U);
  EXPECT_EQ(machine.NextReady({"w3"}, {"w1", "w2", "w3"}, 102.0)->part, 3U);
  EXPECT_EQ(machine.NextReady({"w3"}, {"w3"}, 102.0)->part, 0U);
}

TEST(JobMachineLeases, TellsTheSlotsOfAWorkerApart) {
  const JobMachine machine = SecondRound();
  EXPECT_EQ(machine.NextReady({"w2", 0}, {"w1", "w2"}, 102.0)->part, 2U);
  EXPECT_EQ(machine.NextReady({"w2", 1}, {"w2"}, 102.0)->part, 0U) << "whose worker is gone";
}

TEST(JobMachineLeases, OnlyQuickTasksWaitBehindAnother) {
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

TEST(JobMachineLeases, WhatIsAtHomeElsewhereDoesNotWait) {
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

TEST(JobMachineLeases, TheTimeThatATaskWaitsBehindAnotherIsNotItsOwn) {
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

TEST(JobMachineLeases, GivesWorkersNeighbouringParts) {
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

TEST(JobMachineLeases, AWorkerBeginsWhereNobodyWorksTowards) {
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

}  // namespace
}  // namespace orbweave
