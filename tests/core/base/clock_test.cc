// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/clock.h"

#include <gtest/gtest.h>

#include "tests/support/manual_clock.h"

namespace orbweave {
namespace {

TEST(ManualClock, StandsUntilItIsTurned) {
  ManualClock clock;
  EXPECT_EQ(clock.NowSeconds(), 0.0);
  clock.Advance(2.5);
  clock.Advance(0.5);
  EXPECT_EQ(clock.NowSeconds(), 3.0);
}

TEST(SteadyClock, NeverGoesBack) {
  const SteadyClock clock;
  const double before_s = clock.NowSeconds();
  EXPECT_GE(clock.NowSeconds(), before_s);
}

}  // namespace
}  // namespace orbweave
