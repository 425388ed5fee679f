// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/worker_roster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(WorkerRoster, AKnownNameReplacesItsSession) {
  WorkerRoster roster(10.0);
  roster.Join({.name = "w"}, 1, 0.0);
  roster.Join({.name = "w"}, 2, 1.0);
  EXPECT_TRUE(absl::IsNotFound(roster.Hear(1, 1.0)));
  EXPECT_TRUE(roster.Hear(2, 1.0).ok());
  EXPECT_EQ(roster.SessionOf("w"), 2U);
}

TEST(WorkerRoster, ASilentWorkerIsNotAliveUntilItIsHeardAgain) {
  WorkerRoster roster(10.0);
  roster.Join({.name = "w"}, 1, 0.0);
  EXPECT_THAT(roster.Serving(10.0), ElementsAre("w"));
  EXPECT_THAT(roster.Serving(10.1), IsEmpty());
  EXPECT_TRUE(roster.Hear(1, 12.0).ok());
  EXPECT_THAT(roster.Serving(12.0), ElementsAre("w"));
}

TEST(WorkerRoster, RemembersWhatAWorkerDidAfterItLeft) {
  WorkerRoster roster(10.0);
  roster.Join({.name = "w", .slots = 3}, 1, 0.0);
  roster.CountTask(1, {});
  roster.End(1);
  const std::vector<WorkerStatus> status = roster.Status(0.0);
  ASSERT_EQ(status.size(), 1U);
  EXPECT_EQ(status[0].tasks_done, 1U);
  EXPECT_EQ(status[0].slots, 3U);
  EXPECT_FALSE(status[0].alive);
  EXPECT_EQ(roster.SessionOf("w"), std::nullopt);
}

/// Two workers, of which "bad" failed `tasks` that "good" then did.
WorkerRoster RosterWithBlame(int tasks) {
  WorkerRoster roster(10.0);
  roster.Join({.name = "bad"}, 1, 0.0);
  roster.Join({.name = "good", .slots = 3}, 2, 0.0);
  for (int i = 0; i < tasks; ++i) roster.CountTask(2, {"bad", "good"});
  return roster;
}

TEST(WorkerRoster, SetsAWorkerAsideThatFailedThreeTasksWhichOthersDid) {
  EXPECT_THAT(RosterWithBlame(2).Serving(0.0), ElementsAre("bad", "good"));
  const WorkerRoster roster = RosterWithBlame(3);
  EXPECT_THAT(roster.Serving(0.0), ElementsAre("good"));
  EXPECT_TRUE(roster.Status(0.0)[0].set_aside);
  EXPECT_FALSE(roster.Status(0.0)[1].set_aside);
  EXPECT_EQ(roster.Slots(0.0), 4U);
}

TEST(WorkerRoster, ATaskOfItsOwnClearsAWorker) {
  WorkerRoster roster = RosterWithBlame(2);
  roster.CountTask(1, {});
  roster.CountTask(2, {"bad"});
  EXPECT_THAT(roster.Serving(0.0), ElementsAre("bad", "good"));
}

TEST(WorkerRoster, AWorkerThatJoinsAnewBeginsAnew) {
  WorkerRoster roster = RosterWithBlame(3);
  roster.Join({.name = "bad"}, 3, 0.0);
  EXPECT_THAT(roster.Serving(0.0), ElementsAre("bad", "good"));
}

TEST(WorkerRoster, TheSameProcessIsStillToBlameWhenItJoinsAgain) {
  WorkerRoster roster(10.0);
  roster.Join({.name = "bad", .process = 7}, 1, 0.0);
  roster.Join({.name = "good", .process = 8}, 2, 0.0);
  for (int i = 0; i < 3; ++i) roster.CountTask(2, {"bad"});
  roster.Join({.name = "bad", .process = 7}, 3, 0.0);
  EXPECT_THAT(roster.Serving(0.0), ElementsAre("good"));
  roster.Join({.name = "bad", .process = 9}, 4, 0.0);
  EXPECT_THAT(roster.Serving(0.0), ElementsAre("bad", "good"));
}

TEST(WorkerRoster, TellsWhoseBlamesChangedAndRemembersThem) {
  WorkerRoster roster(10.0);
  roster.Join({.name = "bad", .process = 7}, 1, 0.0);
  roster.Join({.name = "good", .process = 8}, 2, 0.0);
  EXPECT_FALSE(roster.HasBlames());
  roster.CountTask(2, {});
  EXPECT_FALSE(roster.HasBlames()) << "nothing has changed";
  for (int i = 0; i < 3; ++i) roster.CountTask(2, {"bad"});
  ASSERT_TRUE(roster.HasBlames());
  const std::vector<WorkerBlame> blames = roster.TakeBlames();
  ASSERT_EQ(blames.size(), 1U);
  EXPECT_EQ(blames[0].worker, "bad");
  EXPECT_EQ(blames[0].process, 7U);
  EXPECT_EQ(blames[0].blames, 3U);
  EXPECT_FALSE(roster.HasBlames());
  WorkerRoster again(10.0);
  again.Remember(blames[0], 0.0);
  again.Join({.name = "bad", .process = 7}, 1, 0.0);
  again.Join({.name = "good", .process = 8}, 2, 0.0);
  EXPECT_THAT(again.Serving(0.0), ElementsAre("good"));
}

TEST(WorkerRoster, WhoIsToLeaveServesNoMoreUntilItJoinsAnew) {
  WorkerRoster roster(10.0);
  roster.Join({.name = "w"}, 1, 0.0);
  EXPECT_TRUE(absl::IsNotFound(roster.Drain("stranger").status()));
  EXPECT_TRUE(absl::IsNotFound(roster.Drain("").status()));
  EXPECT_FALSE(roster.IsDraining(1));
  EXPECT_THAT(*roster.Drain("w"), ElementsAre("w"));
  EXPECT_TRUE(roster.IsDraining(1));
  EXPECT_TRUE(roster.Status(0.0)[0].draining);
  EXPECT_THAT(roster.Serving(0.0), IsEmpty());
  roster.Join({.name = "w"}, 2, 0.0);
  EXPECT_THAT(roster.Serving(0.0), ElementsAre("w"));
}

TEST(WorkerRoster, AWholeNameMeansItsWorkerThoughOthersBeginSo) {
  WorkerRoster roster(10.0);
  uint64_t session = 0;
  for (const char* name : {"w1", "w10", "w11", "w2"}) roster.Join({.name = name}, ++session, 0.0);
  EXPECT_THAT(*roster.Drain("w1"), ElementsAre("w1"));
  EXPECT_THAT(*roster.Drain("w2"), ElementsAre("w2"));
  EXPECT_TRUE(absl::IsInvalidArgument(roster.Drain("w").status()));
  roster.End(3);
  EXPECT_THAT(*roster.Drain("w1*"), ElementsAre("w1", "w10")) << "the third has left";
}

TEST(WorkerRoster, CountsTheSlotsOfThoseThatAreGivenTasks) {
  WorkerRoster roster = RosterWithBlame(3);
  EXPECT_EQ(roster.SlotsAtWork(0.0), 3U) << "without the one set aside";
  roster.Join({.name = "third", .slots = 2}, 3, 0.0);
  EXPECT_EQ(roster.SlotsAtWork(0.0), 5U);
  ASSERT_TRUE(roster.Drain("third").ok());
  EXPECT_EQ(roster.SlotsAtWork(0.0), 3U);
}

TEST(WorkerRoster, AWorkerHasTheSlotsItJoinedWith) {
  WorkerRoster roster(10.0);
  roster.Join({.name = "w", .slots = 2}, 1, 0.0);
  EXPECT_TRUE(roster.CheckSlot(1, 1).ok());
  EXPECT_TRUE(absl::IsInvalidArgument(roster.CheckSlot(1, 2)));
  EXPECT_TRUE(absl::IsNotFound(roster.CheckSlot(2, 0)));
}

TEST(WorkerRoster, ForgetsThoseGoneForADay) {
  WorkerRoster roster(10.0);
  roster.Join({.name = "left"}, 1, 0.0);
  roster.Join({.name = "silent"}, 2, 0.0);
  roster.Join({.name = "there"}, 3, 0.0);
  roster.End(1);
  ASSERT_TRUE(roster.Hear(3, 86'300.0).ok());
  roster.ForgetGone(86'300.0);
  EXPECT_EQ(roster.Status(86'300.0).size(), 3U);
  ASSERT_TRUE(roster.Hear(3, 86'500.0).ok());
  roster.ForgetGone(86'500.0);
  const std::vector<WorkerStatus> status = roster.Status(86'500.0);
  ASSERT_EQ(status.size(), 1U);
  EXPECT_EQ(status[0].name, "there");
  EXPECT_TRUE(absl::IsNotFound(roster.Hear(2, 86'500.0))) << "it may join again";
}

TEST(WorkerRoster, DoesNotGrowWithEveryNewName) {
  constexpr uint64_t kNames = 20'000;
  WorkerRoster roster(10.0);
  roster.Join({.name = "there"}, kNames, 0.0);
  for (uint64_t i = 0; i < kNames; ++i) {
    roster.Join({.name = "pod" + std::to_string(i)}, kNames + 1 + i, 0.001 * i);
    roster.End(kNames + 1 + i);
    ASSERT_TRUE(roster.Hear(kNames, 0.001 * i).ok());
    roster.ForgetGone(0.001 * i);
  }
  ASSERT_TRUE(roster.Hear(kNames, 120.0).ok()) << "not the one that is there";
  roster.ForgetGone(120.0);
  EXPECT_EQ(roster.Status(120.0).size(), 1001U);
  EXPECT_EQ(roster.Status(120.0).back().name, "there");
  const auto has_last = [&](const WorkerStatus& worker) {
    return worker.name == "pod" + std::to_string(kNames - 1);
  };
  EXPECT_TRUE(std::ranges::any_of(roster.Status(120.0), has_last)) << "the last ones are kept";
}

TEST(WorkerRoster, RemembersThoseSetAsideLongerThanOthersAndClearsTheirBlamesAtLast) {
  WorkerRoster roster(10.0);
  roster.Join({.name = "bad", .process = 7}, 1, 0.0);
  roster.Join({.name = "good"}, 2, 0.0);
  for (int i = 0; i < 3; ++i) roster.CountTask(2, {"bad"});
  roster.End(1);
  (void)roster.TakeBlames();
  for (uint64_t i = 0; i < 3000; ++i) {
    roster.Join({.name = "pod" + std::to_string(i)}, 3 + i, 1.0);
    roster.End(3 + i);
    roster.ForgetGone(1.0);
  }
  EXPECT_FALSE(roster.HasBlames());
  roster.ForgetGone(90'000.0);
  const std::vector<WorkerBlame> blames = roster.TakeBlames();
  ASSERT_EQ(blames.size(), 1U);
  EXPECT_EQ(blames[0].worker, "bad");
  EXPECT_EQ(blames[0].blames, 0U);
}

TEST(WorkerRoster, SetsAWorkerAsideThatLeftThreeDamagedResultsWhateverItDoesBesides) {
  WorkerRoster roster(10.0);
  roster.Join({.name = "bad", .process = 7}, 1, 0.0);
  roster.Join({.name = "good", .process = 8}, 2, 0.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(roster.Serving(0.0), ElementsAre("bad", "good"));
    roster.CountTask(1, {});
    roster.CountDamage("bad");
    roster.CountDamage("forgotten");
  }
  EXPECT_THAT(roster.Serving(0.0), ElementsAre("good"));
  const std::vector<WorkerBlame> blames = roster.TakeBlames();
  ASSERT_EQ(blames.size(), 1U);
  EXPECT_EQ(blames[0].blames, 3U);
  roster.Join({.name = "bad", .process = 9}, 3, 0.0);
  EXPECT_THAT(roster.Serving(0.0), ElementsAre("bad", "good"));
  EXPECT_EQ(roster.TakeBlames().at(0).blames, 0U);
}

TEST(WorkerRoster, NobodyIsMadeKnownByABlame) {
  WorkerRoster roster(10.0);
  roster.Join({.name = "good"}, 1, 0.0);
  roster.CountTask(1, {"forgotten"});
  EXPECT_EQ(roster.Status(0.0).size(), 1U);
}

TEST(WorkerRoster, WhoIsSetAsideServesWhenNobodyElseIsAlive) {
  WorkerRoster roster = RosterWithBlame(3);
  roster.End(2);
  EXPECT_THAT(roster.Serving(0.0), ElementsAre("bad"));
}

}  // namespace
}  // namespace orbweave
