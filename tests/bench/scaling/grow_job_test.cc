// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/grow_job.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

std::vector<StageLoad> SmallJob() {
  return {{"map", {{1.0, 10.0}, {3.0, 30.0}}}, {"join", {{0.5, 8.0}}}, {"pick", {}}};
}

TEST(GrowJob, ByOneIsTheJobItself) {
  const std::vector<StageLoad> grown = GrowJob(SmallJob(), 1.0, {});
  ASSERT_EQ(grown.size(), 3U);
  ASSERT_EQ(grown[0].parts.size(), 2U);
  EXPECT_DOUBLE_EQ(grown[0].parts[1].compute_s, 3.0);
  EXPECT_DOUBLE_EQ(grown[1].parts[0].bytes, 8.0);
  EXPECT_TRUE(grown[2].parts.empty());
}

TEST(GrowJob, RepeatsPartsAndKeepsSerialStagesWhole) {
  const std::vector<StageLoad> grown = GrowJob(SmallJob(), 4.0, {});
  ASSERT_EQ(grown[0].parts.size(), 8U);
  EXPECT_DOUBLE_EQ(grown[0].parts[0].compute_s, 1.0) << "a part of a linear stage stays as it is";
  EXPECT_DOUBLE_EQ(grown[0].parts[7].compute_s, 3.0);
  ASSERT_EQ(grown[1].parts.size(), 1U);
  EXPECT_DOUBLE_EQ(grown[1].parts[0].compute_s, 2.0);
  EXPECT_DOUBLE_EQ(grown[1].parts[0].bytes, 32.0);
  EXPECT_TRUE(grown[2].parts.empty());
}

TEST(GrowJob, TotalsFollowTheExponents) {
  const std::vector<StageLoad> grown =
      GrowJob(SmallJob(), 4.0, {{"map", {.compute = 2.0, .bytes = 1.5}}});
  ASSERT_EQ(grown[0].parts.size(), 8U);
  double compute_s = 0.0;
  double bytes = 0.0;
  for (const PartLoad& part : grown[0].parts) {
    compute_s += part.compute_s;
    bytes += part.bytes;
  }
  EXPECT_NEAR(compute_s, 64.0, 1e-12);
  EXPECT_NEAR(bytes, 320.0, 1e-9);
}

}  // namespace
}  // namespace orbweave
