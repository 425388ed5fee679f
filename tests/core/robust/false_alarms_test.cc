// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/robust/false_alarms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orbweave {
namespace {

TEST(Log10FalseAlarms, IsTheFormulaForSmallNumbers) {
  // (10 - 2) C(10, 4) C(4, 2) 0.1^2
  EXPECT_NEAR(Log10FalseAlarms(10, 4, 2, 0.1), std::log10(8.0 * 210.0 * 6.0 * 0.01), 1e-12);
  EXPECT_NEAR(Log10FalseAlarms(10, 4, 2, 0.1, 4), std::log10(4 * 8.0 * 210.0 * 6.0 * 0.01), 1e-12);
}

TEST(Log10FalseAlarms, SaysNothingOfTheSampleItself) {
  EXPECT_EQ(Log10FalseAlarms(100, 5, 5, 1e-6), 0.0);
  EXPECT_EQ(Log10FalseAlarms(100, 0, 5, 1e-6), 0.0);
}

TEST(Log10FalseAlarms, FallsWithEveryDatumThatFits) {
  for (size_t k = 12; k < 50; ++k) {
    EXPECT_LT(Log10FalseAlarms(100, k + 1, 5, 0.01), Log10FalseAlarms(100, k, 5, 0.01)) << k;
  }
}

TEST(Log10PoissonTail, IsTheSumOfTheTail) {
  double tail = 1.0;
  double term = std::exp(-3.0);
  for (int n = 0; n < 9; ++n) {
    tail -= term;
    term *= 3.0 / (n + 1);
  }
  EXPECT_NEAR(Log10PoissonTail(9, 3.0), std::log10(tail), 1e-9);
}

TEST(Log10PoissonTail, IsNoEvidenceUpToTheMean) {
  EXPECT_EQ(Log10PoissonTail(0, 2.0), 0.0);
  EXPECT_EQ(Log10PoissonTail(5, 5.0), 0.0);
  EXPECT_LT(Log10PoissonTail(6, 5.0), 0.0);
}

}  // namespace
}  // namespace orbweave
