// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/stage_totals.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(SumByStage, AddsRoundsAndKeepsTheLongestOfEach) {
  const auto cost = [](double cpu_s, uint64_t peak) {
    return TaskCost{.cpu_s = cpu_s, .bytes_in = 10, .bytes_out = 1, .peak_memory_bytes = peak};
  };
  const std::vector<StageTotals> totals = SumByStage({{0, "steer", 0, cost(1.0, 5)},
                                                      {1, "adjust", 0, cost(2.0, 9)},
                                                      {1, "adjust", 1, cost(3.0, 7)},
                                                      {2, "steer", 0, cost(1.5, 6)},
                                                      {3, "adjust", 0, cost(4.0, 8)},
                                                      {3, "adjust", 1, cost(1.0, 1)}});
  ASSERT_EQ(totals.size(), 2U);
  EXPECT_EQ(totals[0].stage, "steer");
  EXPECT_EQ(totals[0].runs, 2U);
  EXPECT_EQ(totals[0].longest_cpu_s, totals[0].cpu_s) << "one task a run: nothing to divide";
  EXPECT_EQ(totals[1].stage, "adjust");
  EXPECT_EQ(totals[1].tasks, 4U);
  EXPECT_EQ(totals[1].cpu_s, 10.0);
  EXPECT_EQ(totals[1].longest_cpu_s, 7.0);
  EXPECT_EQ(totals[1].bytes_in, 40U);
  EXPECT_EQ(totals[1].bytes_out, 4U);
  EXPECT_EQ(totals[1].peak_memory_bytes, 9U);
}

TEST(SumByStage, OfNothingIsNothing) { EXPECT_TRUE(SumByStage({}).empty()); }

}  // namespace
}  // namespace orbweave
