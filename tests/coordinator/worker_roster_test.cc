// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/worker_roster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  again.Remember(blames[0]);
  again.Join({.name = "bad", .process = 7}, 1, 0.0);
  again.Join({.name = "good", .process = 8}, 2, 0.0);
  EXPECT_THAT(again.Serving(0.0), ElementsAre("good"));
}

TEST(WorkerRoster, WhoIsToLeaveServesNoMoreUntilItJoinsAnew) {
  WorkerRoster roster(10.0);
  roster.Join({.name = "w"}, 1, 0.0);
  EXPECT_TRUE(absl::IsNotFound(roster.Drain("stranger")));
  EXPECT_FALSE(roster.IsDraining(1));
  ASSERT_TRUE(roster.Drain("w").ok());
  EXPECT_TRUE(roster.IsDraining(1));
  EXPECT_TRUE(roster.Status(0.0)[0].draining);
  EXPECT_THAT(roster.Serving(0.0), IsEmpty());
  roster.Join({.name = "w"}, 2, 0.0);
  EXPECT_THAT(roster.Serving(0.0), ElementsAre("w"));
}

TEST(WorkerRoster, WhoIsSetAsideServesWhenNobodyElseIsAlive) {
  WorkerRoster roster = RosterWithBlame(3);
  roster.End(2);
  EXPECT_THAT(roster.Serving(0.0), ElementsAre("bad"));
}

}  // namespace
}  // namespace orbweave
