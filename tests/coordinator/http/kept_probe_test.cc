// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/http/kept_probe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "tests/support/command.h"
#include "tests/support/manual_clock.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using testing::WaitUntil;

constexpr ProbePatience kPatient{.keep_s = 1.0, .wait_s = 3600.0};

TEST(KeptProbe, AsksWhenItIsAskedAndKeepsTheAnswer) {
  ManualClock clock;
  std::atomic<int> probes{0};
  KeptProbe probe(
      [&] {
        ++probes;
        return absl::DataLossError("gone");
      },
      clock,
      kPatient);
  EXPECT_EQ(probes, 0);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(absl::IsDataLoss(probe.Ask()));
  clock.Advance(0.9);
  EXPECT_TRUE(absl::IsDataLoss(probe.Ask()));
  EXPECT_EQ(probes, 1);
  clock.Advance(0.2);
  EXPECT_TRUE(absl::IsDataLoss(probe.Ask()));
  EXPECT_EQ(probes, 2);
}

TEST(KeptProbe, GivesNoAnswerOfBefore) {
  ManualClock clock;
  std::atomic<bool> is_well{true};
  KeptProbe probe(
      [&] { return is_well ? absl::OkStatus() : absl::DataLossError("gone"); }, clock, kPatient);
  EXPECT_TRUE(probe.Ask().ok());
  is_well = false;
  clock.Advance(2.0);
  EXPECT_TRUE(absl::IsDataLoss(probe.Ask()));
  is_well = true;
  clock.Advance(2.0);
  EXPECT_TRUE(probe.Ask().ok());
}

TEST(KeptProbe, SaysSinceWhenTheProbeHasNotComeBackAndSendsNoOther) {
  ManualClock clock;
  std::atomic<int> probes{0};
  std::atomic<bool> may_answer{false};
  KeptProbe probe(
      [&] {
        ++probes;
        WaitUntil([&] { return may_answer.load(); }, 30.0);
        return absl::OkStatus();
      },
      clock,
      {.keep_s = 1.0, .wait_s = 0.0});
  EXPECT_TRUE(absl::IsUnavailable(probe.Ask()));
  clock.Advance(12.0);
  const absl::Status away = probe.Ask();
  EXPECT_TRUE(absl::IsUnavailable(away));
  EXPECT_THAT(std::string(away.message()), HasSubstr("for 12 s"));
  EXPECT_TRUE(WaitUntil([&] { return probes == 1; }, 30.0));
  may_answer = true;
  EXPECT_TRUE(WaitUntil([&] { return probe.Ask().ok(); }, 30.0));
  EXPECT_EQ(probes, 1);
}

TEST(KeptProbe, AnswersAllWhoAskAtOnceByOneProbe) {
  ManualClock clock;
  std::atomic<int> probes{0};
  std::atomic<int> answers{0};
  KeptProbe probe(
      [&] {
        ++probes;
        return absl::OkStatus();
      },
      clock,
      kPatient);
  {
    std::vector<std::jthread> askers;
    for (int i = 0; i < 8; ++i) {
      askers.emplace_back([&] {
        if (probe.Ask().ok()) ++answers;
      });
    }
  }
  EXPECT_EQ(answers, 8);
  EXPECT_EQ(probes, 1);
}

}  // namespace
}  // namespace orbweave
