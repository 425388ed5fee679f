// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/robust/early_rejection.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace orbweave {
namespace {

/// Whether a model with the given share of inliers among 2,000 data is rejected on the way.
bool IsRejected(const EarlyRejection& gate, double inlier_share, Random& random) {
  uint32_t num_inliers = 0;
  for (size_t seen = 1; seen <= 2000; ++seen) {
    num_inliers += random.Uniform() < inlier_share ? 1U : 0U;
    if (seen % EarlyRejection::kBlock == 0 && gate.Rejects(0.0, num_inliers, seen)) return true;
  }
  return false;
}

TEST(EarlyRejection, LetsEverythingPassAtFirst) {
  const EarlyRejection gate(2000);
  EXPECT_FALSE(gate.Rejects(1e9, 0, 2000));
}

TEST(EarlyRejection, RejectsWhatCostsMoreThanTheBest) {
  EarlyRejection gate(2000);
  gate.Raise(10.0, 1000);
  EXPECT_TRUE(gate.Rejects(10.0, 60, 64));
  EXPECT_FALSE(gate.Rejects(9.0, 60, 64));
}

TEST(EarlyRejection, KeepsGoodModelsAndStopsWrongOnes) {
  EarlyRejection gate(2000);
  gate.Raise(10.0, 600);
  Random random(1);
  int good_lost = 0;
  int wrong_kept = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    good_lost += IsRejected(gate, 0.3, random) ? 1 : 0;
    wrong_kept += IsRejected(gate, 0.02, random) ? 0 : 1;
  }
  EXPECT_LE(good_lost, 4);  // Wald: at most one in a thousand
  EXPECT_EQ(wrong_kept, 0);
}

TEST(EarlyRejection, StopsWrongModelsOfUselessSupportFromTheStart) {
  const EarlyRejection gate(2000, 0.1);
  Random random(2);
  int useful_lost = 0;
  int wrong_kept = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    useful_lost += IsRejected(gate, 0.1, random) ? 1 : 0;
    wrong_kept += IsRejected(gate, 0.01, random) ? 0 : 1;
  }
  EXPECT_LE(useful_lost, 4);
  EXPECT_EQ(wrong_kept, 0);
}

}  // namespace
}  // namespace orbweave
