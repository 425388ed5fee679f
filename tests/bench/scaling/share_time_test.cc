// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/share_time.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TaskTiming Attempt(
    uint32_t run, uint32_t part, const char* worker, double start_s, double end_s, bool ok = true) {
  return {.run = run, .part = part, .worker = worker, .start_s = start_s, .end_s = end_s, .ok = ok};
}

MeasuredTask Task(uint32_t run, uint32_t part, double wall_s, double cpu_s) {
  return {.run = run, .part = part, .cost = {.wall_s = wall_s, .cpu_s = cpu_s}};
}

TEST(ShareTime, KnowsACauseForEverySecond) {
  // Run 0 has one task, run 1 three; two slots, 20 s.
  const std::vector<TaskTiming> timings = {Attempt(0, 0, "a", 1.0, 4.0),
                                           Attempt(1, 0, "a", 5.0, 9.0),
                                           Attempt(1, 1, "b", 5.5, 8.0),
                                           Attempt(1, 2, "b", 8.5, 18.0)};
  const std::vector<MeasuredTask> tasks = {
      Task(0, 0, 2.5, 2.0), Task(1, 0, 3.0, 3.0), Task(1, 1, 2.0, 1.5), Task(1, 2, 9.0, 9.0)};
  const TimeShares shares = ShareTime(timings, tasks, 2, 1.0, 20.0);
  EXPECT_NEAR(shares.computing_s, 2.0 + 3.0 + 1.5 + 9.0, 1e-12);
  EXPECT_NEAR(shares.waiting_s, 0.5 + 0.5, 1e-12);
  // Handing in 0.5, 1, 0.5 and 0.5; b waits for its first task of run 1 and between its two.
  EXPECT_NEAR(shares.leasing_s, 2.5 + 0.5 + 0.5, 1e-12);
  EXPECT_NEAR(shares.serial_s, 3.0, 1e-12) << "b, while a has the one task";
  EXPECT_NEAR(shares.barrier_s, 9.0, 1e-12) << "a, while b has the last";
  EXPECT_NEAR(shares.planning_s, 2.0 * (1.0 + 1.0 + 2.0), 1e-12);
  EXPECT_EQ(shares.repeated_s, 0.0);
  EXPECT_NEAR(shares.Sum(), 40.0, 1e-12);
}

TEST(ShareTime, CountsAttemptsThatCameToNothingAndSlotsThatHadNone) {
  const std::vector<TaskTiming> timings = {Attempt(0, 0, "a", 0.0, 4.0, false),
                                           Attempt(0, 0, "a", 4.0, 10.0)};
  const TimeShares shares = ShareTime(timings, {Task(0, 0, 6.0, 6.0)}, 3, 1.0, 10.0);
  EXPECT_NEAR(shares.repeated_s, 4.0, 1e-12);
  EXPECT_NEAR(shares.computing_s, 6.0, 1e-12);
  EXPECT_NEAR(shares.serial_s, 20.0, 1e-12) << "of two slots that were given nothing";
  EXPECT_NEAR(shares.Sum(), 30.0, 1e-12);
}

TEST(ShareTime, ASlotWithAShareOfAProcessorComputesForLonger) {
  const TimeShares shares =
      ShareTime({Attempt(0, 0, "a", 0.0, 10.0)}, {Task(0, 0, 9.0, 2.0)}, 1, 0.25, 10.0);
  EXPECT_NEAR(shares.computing_s, 8.0, 1e-12);
  EXPECT_NEAR(shares.waiting_s, 1.0, 1e-12);
  EXPECT_NEAR(shares.leasing_s, 1.0, 1e-12);
}

TEST(ShareTime, OfNothingIsPlanning) {
  EXPECT_NEAR(ShareTime({}, {}, 2, 1.0, 5.0).planning_s, 10.0, 1e-12);
}

}  // namespace
}  // namespace orbweave
