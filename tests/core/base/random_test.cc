// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/random.h"

#include <gtest/gtest.h>

#include <array>

namespace orbweave {
namespace {

constexpr int kDraws = 100000;

TEST(Random, IsSplitMix64) {
  Random random(uint64_t{1234567});
  EXPECT_EQ(random.Next(), 6457827717110365317ULL);
  EXPECT_EQ(random.Next(), 3203168211198807973ULL);
  EXPECT_EQ(random.Next(), 9817491932198370423ULL);
}

TEST(Random, RepeatsItselfForASeed) {
  Random a("images 3 and 4");
  Random b("images 3 and 4");
  Random c("images 3 and 5");
  EXPECT_EQ(a.Next(), b.Next());
  EXPECT_NE(a.Next(), c.Next());
}

TEST(Random, IsUniform) {
  Random random(uint64_t{1});
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.Uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    sum_of_squares += u * u;
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 0.005);
  EXPECT_NEAR(sum_of_squares / kDraws, 1.0 / 3.0, 0.005);
}

TEST(Random, StaysWithinBounds) {
  Random random(uint64_t{2});
  for (int i = 0; i < 1000; ++i) {
    const double u = random.Uniform(-3.0, 5.0);
    ASSERT_GE(u, -3.0);
    ASSERT_LT(u, 5.0);
  }
}

TEST(Random, DrawsEveryIndexAlike) {
  Random random(uint64_t{3});
  std::array<int, 7> counts{};
  for (int i = 0; i < kDraws; ++i) ++counts.at(random.Index(7));
  for (const int count : counts) EXPECT_NEAR(count, kDraws / 7.0, 500.0);
  EXPECT_EQ(random.Index(1), 0U);
}

TEST(Random, IsNormal) {
  Random random(uint64_t{4});
  std::array<double, 5> moments{};
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.Normal();
    double power = 1.0;
    for (double& moment : moments) {
      moment += power / kDraws;
      power *= x;
    }
  }
  EXPECT_NEAR(moments[1], 0.0, 0.02);
  EXPECT_NEAR(moments[2], 1.0, 0.02);
  EXPECT_NEAR(moments[3], 0.0, 0.06);
  EXPECT_NEAR(moments[4], 3.0, 0.15);
}

}  // namespace
}  // namespace orbweave
