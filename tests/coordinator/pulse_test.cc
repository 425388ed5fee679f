// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/pulse.h"

#include <gtest/gtest.h>

#include "tests/support/manual_clock.h"

namespace orbweave {
namespace {

TEST(Pulse, IsFeltForAPeriodAfterABeat) {
  Pulse pulse;
  pulse.Beat(100.0);
  EXPECT_TRUE(pulse.IsFelt(20.0, 100.0));
  EXPECT_TRUE(pulse.IsFelt(20.0, 119.0));
  EXPECT_FALSE(pulse.IsFelt(20.0, 121.0));
  pulse.Beat(121.0);
  EXPECT_TRUE(pulse.IsFelt(20.0, 121.0));
  EXPECT_TRUE(pulse.IsFelt(20.0, 120.9)) << "who asks looked at the clock before";
}

TEST(Pulse, IsFeltWhileItRestsAndBeforeItBeginsToBeat) {
  Pulse pulse;
  EXPECT_TRUE(pulse.IsFelt(20.0, 1e9));
  pulse.Beat(0.0);
  EXPECT_FALSE(pulse.IsFelt(20.0, 1e9));
  pulse.Rest();
  EXPECT_TRUE(pulse.IsFelt(20.0, 1e9));
}

TEST(PulseAtRest, BeatsWhenTheRestIsOver) {
  Pulse pulse;
  ManualClock clock;
  {
    const PulseAtRest rest(pulse, clock);
    clock.Advance(1000.0);
    EXPECT_TRUE(pulse.IsFelt(20.0, clock.NowSeconds()));
  }
  clock.Advance(19.0);
  EXPECT_TRUE(pulse.IsFelt(20.0, clock.NowSeconds()));
  clock.Advance(2.0);
  EXPECT_FALSE(pulse.IsFelt(20.0, clock.NowSeconds()));
}

}  // namespace
}  // namespace orbweave
