// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include "tests/coordinator/line_job.h"

namespace orbweave {
namespace {

using testing::Begin;
using testing::LeaseNext;
using testing::MachineFor;

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

TEST(JobMachineStragglers, LetsAnIdleWorkerRepeatAStraggler) {
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

TEST(JobMachineStragglers, AFailedRepetitionLeavesTheOtherAttemptAlone) {
  JobMachine machine = MachineWithStragglers(3, 1);
  const AttemptRef slow{{0, 2}, 1002};
  machine.TaskLeased(slow.task, {.epoch = 7, .worker = "w"}, 200.0);
  machine.TaskFailed({slow.task, 7}, absl::InternalError("no luck"), 201.0);
  EXPECT_EQ(machine.NextReady({"w2"}, {"w2"}, 300.0), std::nullopt);
  EXPECT_EQ(machine.Status(201.0).stages[0].tasks_running, 1U);
  machine.TaskDone(slow, {}, 210.0);
  EXPECT_EQ(machine.state(), JobState::kDone);
}

TEST(JobMachineStragglers, RepeatsNoMoreThanAShareOfTheSlots) {
  JobMachine machine = MachineWithStragglers(8, 4);
  for (const uint32_t part : {4U, 5U}) {
    ASSERT_EQ(machine.NextStraggler("w", 20, 500.0), (TaskRef{0, part}));
    machine.TaskLeased({0, part}, {.epoch = part, .worker = "w"}, 500.0);
  }
  EXPECT_EQ(machine.NextStraggler("w", 20, 500.0), std::nullopt);
  EXPECT_EQ(machine.NextStraggler("w", 30, 500.0), (TaskRef{0, 6}));
}

TEST(JobMachineStragglers, KnowsNoStragglersBeforeHalfOfTheStageIsDone) {
  JobMachine machine = MachineWithStragglers(5, 3);
  EXPECT_EQ(machine.NextStraggler("w", 100, 9999.0), std::nullopt);
}

}  // namespace
}  // namespace orbweave
