// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/wanted_slots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/random.h"

namespace orbweave {
namespace {

constexpr uint32_t kNoLimit = std::numeric_limits<uint32_t>::max();

TEST(WantedSlots, AreNoneWhereNothingWasNoted) {
  EXPECT_EQ(WantedSlots(kNoLimit).At(0.0), 0U);
  EXPECT_EQ(WantedSlots(kNoLimit).At(1e9), 0U);
}

TEST(WantedSlots, RiseAtOnceAndFallAfterAMinute) {
  WantedSlots slots(kNoLimit);
  slots.Note(3, 100.0);
  EXPECT_EQ(slots.At(100.0), 3U);
  slots.Note(8, 110.0);
  EXPECT_EQ(slots.At(110.0), 8U);
  slots.Note(1, 120.0);
  EXPECT_EQ(slots.At(120.0), 8U);
  EXPECT_EQ(slots.At(179.9), 8U);
  EXPECT_EQ(slots.At(180.1), 1U);
}

TEST(WantedSlots, OutlastASerialStageBetweenTwoWideOnes) {
  WantedSlots slots(kNoLimit);
  slots.Note(500, 0.0);
  slots.Note(1, 1000.0);
  EXPECT_EQ(slots.At(1030.0), 500U);
  slots.Note(400, 1040.0);
  EXPECT_EQ(slots.At(1059.0), 500U);
  EXPECT_EQ(slots.At(1061.0), 400U) << "not the one of the stage between";
}

TEST(WantedSlots, FallStepByStep) {
  WantedSlots slots(kNoLimit);
  slots.Note(9, 0.0);
  slots.Note(5, 10.0);
  slots.Note(2, 20.0);
  slots.Note(0, 30.0);
  EXPECT_EQ(slots.At(69.0), 9U);
  EXPECT_EQ(slots.At(71.0), 5U);
  EXPECT_EQ(slots.At(81.0), 2U);
  EXPECT_EQ(slots.At(91.0), 0U);
}

TEST(WantedSlots, StayAsLongAsTheTasksDo) {
  WantedSlots slots(kNoLimit);
  for (int second = 0; second < 1000; ++second) slots.Note(7, second);
  EXPECT_EQ(slots.At(1e6), 7U) << "nothing was noted since";
}

TEST(WantedSlots, AreNotMoreThanTheLimit) {
  WantedSlots slots(4);
  slots.Note(100, 0.0);
  EXPECT_EQ(slots.At(0.0), 4U);
  slots.Note(2, 1.0);
  EXPECT_EQ(slots.At(1.0), 4U);
  EXPECT_EQ(slots.At(62.0), 2U);
  WantedSlots none(0);
  none.Note(100, 0.0);
  EXPECT_EQ(none.At(0.0), 0U);
  WantedSlots many(kNoLimit);
  many.Note(uint64_t{1} << 40, 0.0);
  EXPECT_EQ(many.At(0.0), kNoLimit);
}

TEST(WantedSlots, AreTheMostOfTheLastMinuteOfAnyHistory) {
  Random random(1);
  WantedSlots slots(kNoLimit);
  std::vector<std::pair<double, uint64_t>> history = {{-1.0, 0}};
  double now_s = 0.0;
  for (int i = 0; i < 3000; ++i) {
    now_s += random.Uniform(0.0, i % 100 == 0 ? 100.0 : 5.0);
    if (random.Index(3) > 0) {
      history.emplace_back(now_s, random.Index(20));
      slots.Note(history.back().second, now_s);
    }
    uint64_t most = history.back().second;
    for (size_t k = 0; k + 1 < history.size(); ++k) {
      if (history[k + 1].first + WantedSlots::kHold_s >= now_s)
        most = std::max(most, history[k].second);
    }
    ASSERT_EQ(slots.At(now_s), most) << i;
  }
}

}  // namespace
}  // namespace orbweave
