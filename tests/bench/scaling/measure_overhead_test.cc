// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/measure_overhead.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(MeasureOverhead, IsWhatIsInNoTask) {
  // One worker; each task is held 0.1 s longer than it computes, the next comes 0.02 s later, and
  // a new run 0.5 s after the one before.
  std::vector<TaskTiming> timings;
  std::vector<MeasuredTask> tasks;
  double now_s = 0.5;
  for (uint32_t run = 0; run < 3; ++run) {
    for (uint32_t part = 0; part < 4; ++part) {
      const double wall_s = 1.0 + part;
      tasks.push_back({run, "a", part, {.wall_s = wall_s}});
      timings.push_back({.run = run,
                         .stage = "a",
                         .part = part,
                         .worker = "w",
                         .start_s = now_s,
                         .end_s = now_s + wall_s + 0.1});
      now_s = timings.back().end_s + (part == 3 ? 0.5 : 0.02);
    }
  }
  const ScheduleOverhead overhead = MeasureOverhead(timings, tasks);
  EXPECT_NEAR(overhead.task_s, 0.12, 1e-12);
  EXPECT_NEAR(overhead.stage_s, 0.5, 1e-12);
}

TEST(MeasureOverhead, DoesNotCountFailedAttempts) {
  const std::vector<MeasuredTask> tasks = {{0, "a", 0, {.wall_s = 1.0}}};
  const std::vector<TaskTiming> timings = {
      {.worker = "v", .start_s = 0.0, .end_s = 50.0, .ok = false},
      {.worker = "w", .start_s = 0.0, .end_s = 1.25}};
  EXPECT_DOUBLE_EQ(MeasureOverhead(timings, tasks).task_s, 0.25);
}

TEST(MeasureOverhead, OfNothingIsZero) {
  EXPECT_EQ(MeasureOverhead({}, {}).task_s, 0.0);
  EXPECT_EQ(MeasureOverhead({}, {}).stage_s, 0.0);
}

}  // namespace
}  // namespace orbweave
