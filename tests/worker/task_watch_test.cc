// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/task_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

constexpr TaskLimits kLimits{.stall_s = 100.0, .total_s = 1000.0};

TEST(TaskWatch, ATaskWithoutASignOfLifeHangs) {
  TaskWatch watch(kLimits, 50.0, 7.0);
  EXPECT_FALSE(watch.Look(149.0, 7.0));
  ASSERT_TRUE(watch.Look(150.0, 7.0));
  EXPECT_THAT(*watch.Look(150.0, 7.0), HasSubstr("no sign of life for 100 s"));
}

TEST(TaskWatch, ASignStartsTheWaitAnew) {
  TaskWatch watch(kLimits, 0.0, 0.0);
  watch.SawSign(90.0, 0.0);
  EXPECT_FALSE(watch.Look(189.0, 0.0));
  EXPECT_TRUE(watch.Look(190.0, 0.0));
}

TEST(TaskWatch, ATaskThatUsesAsGoodAsNoProcessorTimeHangs) {
  TaskWatch idle(kLimits, 0.0, 0.0);
  TaskWatch busy(kLimits, 0.0, 0.0);
  EXPECT_FALSE(idle.Look(99.0, 0.9));
  EXPECT_TRUE(idle.Look(100.0, 0.9));
  EXPECT_FALSE(busy.Look(99.0, 1.1));
  EXPECT_FALSE(busy.Look(198.0, 1.9));
  EXPECT_TRUE(busy.Look(199.0, 1.9));
}

TEST(TaskWatch, ATaskThatComputesWithoutASignSpins) {
  TaskWatch watch(kLimits, 50.0, 7.0);
  EXPECT_FALSE(watch.Look(149.0, 106.0));
  ASSERT_TRUE(watch.Look(150.0, 107.0));
  EXPECT_THAT(*watch.Look(150.0, 107.0), HasSubstr("it spun: no sign of life for 100 s of"));
}

TEST(TaskWatch, ATaskThatTheMachineGivesLittleTimeMayTakeLonger) {
  TaskWatch watch(kLimits, 0.0, 0.0);
  for (double now_s = 10.0; now_s < 950.0; now_s += 10.0)
    EXPECT_FALSE(watch.Look(now_s, 0.1 * now_s)) << now_s;
}

TEST(TaskWatch, ManyThreadsDoNotMakeTheWaitShorter) {
  TaskWatch watch(kLimits, 0.0, 0.0);
  EXPECT_FALSE(watch.Look(99.0, 16 * 99.0));
  EXPECT_TRUE(watch.Look(100.0, 16 * 100.0));
}

TEST(TaskWatch, AWorkingTaskShowsLifeAndMayTakeLonger) {
  TaskWatch watch(kLimits, 0.0, 0.0);
  for (double now_s = 10.0; now_s < 1000.0; now_s += 10.0) {
    EXPECT_FALSE(watch.Look(now_s, now_s)) << now_s;
    watch.SawSign(now_s, now_s);
  }
}

TEST(TaskWatch, NoSignOfLifeBuysMoreThanTheTotal) {
  TaskWatch watch(kLimits, 0.0, 0.0);
  for (double now_s = 0.0; now_s < 1000.0; now_s += 10.0) {
    watch.SawSign(now_s, now_s);
    EXPECT_FALSE(watch.Look(now_s, now_s)) << now_s;
  }
  watch.SawSign(1000.0, 1000.0);
  ASSERT_TRUE(watch.Look(1000.0, 1000.0));
  EXPECT_THAT(*watch.Look(1000.0, 1000.0), HasSubstr("longer than 1000 s"));
}

}  // namespace
}  // namespace orbweave
