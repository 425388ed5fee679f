// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/simulate_schedule.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace orbweave {
namespace {

StageLoad RunOf(const std::string& stage, const std::vector<double>& seconds) {
  StageLoad run{.stage = stage};
  for (const double s : seconds) run.parts.push_back({.compute_s = s});
  return run;
}

std::vector<StageLoad> RandomJob() {
  Random random(3);
  std::vector<StageLoad> job;
  for (int k = 0; k < 6; ++k) {
    StageLoad& run = job.emplace_back();
    for (int p = 0; p < 1 + 40 * (k % 2); ++p)
      run.parts.push_back({random.Uniform(0.1, 9.0), random.Uniform(0.0, 1e8)});
  }
  return job;
}

FleetModel SomeModel() {
  return {.task_overhead_s = 0.2, .stage_overhead_s = 0.5, .coordinator_s_per_task = 0.03};
}

double SumOf(const std::vector<StageLoad>& runs, const FleetModel& model) {
  double sum_s = 0.0;
  for (const StageLoad& run : runs) {
    for (const PartLoad& part : run.parts)
      sum_s += model.task_overhead_s + part.compute_s + 8e-9 * part.bytes / model.worker_gbit_per_s;
  }
  return sum_s;
}

TEST(SimulateSchedule, FollowsAKnownSchedule) {
  const std::vector<StageLoad> job = {
      RunOf("a", {3, 1, 1, 4}), RunOf("b", {2}), RunOf("a", {1, 1, 1})};
  const Schedule two = SimulateSchedule(job, 2, {});
  ASSERT_EQ(two.run_s.size(), 3U);
  EXPECT_DOUBLE_EQ(two.run_s[0], 6.0) << "3 | 1 1 4: in part order, not longest first";
  EXPECT_DOUBLE_EQ(two.run_s[1], 2.0);
  EXPECT_DOUBLE_EQ(two.run_s[2], 2.0);
  EXPECT_DOUBLE_EQ(two.makespan_s, 10.0);
}

TEST(SimulateSchedule, OneWorkerTakesTheSumOfAllTasks) {
  const std::vector<StageLoad> job = RandomJob();
  const FleetModel model = SomeModel();
  const double breaks_s = static_cast<double>(job.size()) * model.stage_overhead_s;
  EXPECT_NEAR(SimulateSchedule(job, 1, model).makespan_s, SumOf(job, model) + breaks_s, 1e-9);
}

TEST(SimulateSchedule, AWorkerForEachTaskTakesTheCriticalPath) {
  FleetModel model = SomeModel();
  model.coordinator_s_per_task = 0.0;
  model.coordinator_gbit_per_s = 1e9;
  const std::vector<StageLoad> job = RandomJob();
  EXPECT_DOUBLE_EQ(SimulateSchedule(job, 1000, model).makespan_s,
                   CriticalPath(job, model).makespan_s);
}

TEST(SimulateSchedule, MoreWorkersAreNeverSlowerNorBetterThanTheirNumber) {
  const std::vector<StageLoad> job = RandomJob();
  const FleetModel model = SomeModel();
  double before_s = SimulateSchedule(job, 1, model).makespan_s;
  for (uint32_t workers = 2; workers < 60; ++workers) {
    const double now_s = SimulateSchedule(job, workers, model).makespan_s;
    EXPECT_LE(now_s, before_s) << workers;
    EXPECT_GE(now_s, SumOf(job, model) / workers) << workers;
    EXPECT_GE(now_s, CriticalPath(job, model).makespan_s) << workers;
    before_s = now_s;
  }
}

TEST(SimulateSchedule, BytesTakeTimeOnBothLinks) {
  StageLoad run;
  for (int p = 0; p < 100; ++p) run.parts.push_back({.compute_s = 1.0, .bytes = 1e9});
  const FleetModel model{.worker_gbit_per_s = 4.0, .coordinator_gbit_per_s = 10.0};
  EXPECT_DOUBLE_EQ(SimulateSchedule({run}, 2, model).makespan_s, 150.0) << "1 s and 2 s a task";
  EXPECT_DOUBLE_EQ(SimulateSchedule({run}, 100, model).makespan_s, 80.0) << "100 GB at 10 Gbit/s";
}

TEST(SimulateSchedule, TheCoordinatorServesOneTaskAfterAnother) {
  const FleetModel model{.coordinator_s_per_task = 0.5};
  EXPECT_DOUBLE_EQ(SimulateSchedule({RunOf("a", {1, 1, 1, 1, 1, 1})}, 6, model).makespan_s, 3.0);
}

TEST(SimulateSchedule, ARunHasRoomWhereWorkersOfferWhatItNeeds) {
  StageLoad run = RunOf("a", {1, 1, 1, 1, 1, 1});
  FleetModel model{.slots = 3, .offers = {.memory_bytes = 100, .threads = 4}};
  EXPECT_DOUBLE_EQ(SimulateSchedule({run}, 1, model).makespan_s, 2.0) << "three at a time";
  run.needs.memory_bytes = 50;
  EXPECT_DOUBLE_EQ(SimulateSchedule({run}, 1, model).makespan_s, 3.0);
  run.needs.threads = 3;
  EXPECT_DOUBLE_EQ(SimulateSchedule({run}, 1, model).makespan_s, 6.0);
  EXPECT_DOUBLE_EQ(SimulateSchedule({run}, 2, model).makespan_s, 3.0);
  run.needs.gpus = 1;
  EXPECT_TRUE(std::isinf(SimulateSchedule({run}, 1000, model).makespan_s));
  EXPECT_TRUE(std::isinf(CriticalPath({run}, model).makespan_s));
  model.offers.gpus = 1;
  EXPECT_DOUBLE_EQ(SimulateSchedule({run}, 2, model).makespan_s, 3.0);
}

TEST(SimulateSchedule, TasksOfAWorkerShareItsLink) {
  StageLoad run;
  for (int p = 0; p < 4; ++p) run.parts.push_back({.bytes = 1e9});
  FleetModel model{.worker_gbit_per_s = 4.0, .coordinator_gbit_per_s = 1e9};
  const double one_slot_s = SimulateSchedule({run}, 1, model).makespan_s;
  model.slots = 4;
  EXPECT_DOUBLE_EQ(SimulateSchedule({run}, 1, model).makespan_s, one_slot_s);
}

TEST(SimulateSchedule, AJobWithoutTasksTakesNoTime) {
  EXPECT_EQ(SimulateSchedule({}, 5, SomeModel()).makespan_s, 0.0);
  EXPECT_EQ(SimulateSchedule({RunOf("a", {})}, 5, {}).makespan_s, 0.0);
}

TEST(StageLoadsOf, EachRoundOfALoopIsARun) {
  const TaskCost cost{.wall_s = 9.0, .cpu_s = 2.0, .bytes_in = 30, .bytes_out = 4};
  const std::vector<StageLoad> runs = StageLoadsOf(
      {{0, "steer", 0, cost}, {1, "adjust", 0, cost}, {1, "adjust", 1, {}}, {2, "steer", 0, cost}});
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_EQ(runs[1].stage, "adjust");
  ASSERT_EQ(runs[1].parts.size(), 2U);
  EXPECT_EQ(runs[1].parts[0].compute_s, 2.0);
  EXPECT_EQ(runs[1].parts[0].bytes, 34.0);
  EXPECT_EQ(runs[2].stage, "steer");
}

}  // namespace
}  // namespace orbweave
