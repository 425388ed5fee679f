// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/sleep.h"

#include <gtest/gtest.h>

#include <thread>

#include "core/base/clock.h"

namespace orbweave {
namespace {

TEST(SleepUnlessStopped, SleepsAsLongAsItIsTold) {
  const SteadyClock clock;
  const double begin_s = clock.NowSeconds();
  EXPECT_TRUE(SleepUnlessStopped(0.05, {}));
  EXPECT_GE(clock.NowSeconds() - begin_s, 0.05);
}

TEST(SleepUnlessStopped, DoesNotBeginWhenItIsStoppedAlready) {
  std::stop_source source;
  source.request_stop();
  EXPECT_FALSE(SleepUnlessStopped(1e6, source.get_token()));
}

TEST(SleepUnlessStopped, EndsWhenItIsStopped) {
  bool slept = true;
  std::jthread sleeper([&](const std::stop_token& stop) { slept = SleepUnlessStopped(1e6, stop); });
  sleeper.request_stop();
  sleeper.join();
  EXPECT_FALSE(slept);
}

TEST(SleepUntilStopped, EndsWhenItIsStopped) {
  std::jthread sleeper(SleepUntilStopped);
  sleeper.request_stop();
  sleeper.join();
  SUCCEED();
}

}  // namespace
}  // namespace orbweave
