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
  EXPECT_THAT(roster.Alive(10.0), ElementsAre("w"));
  EXPECT_THAT(roster.Alive(10.1), IsEmpty());
  EXPECT_TRUE(roster.Hear(1, 12.0).ok());
  EXPECT_THAT(roster.Alive(12.0), ElementsAre("w"));
}

TEST(WorkerRoster, RemembersWhatAWorkerDidAfterItLeft) {
  WorkerRoster roster(10.0);
  roster.Join({.name = "w", .slots = 3}, 1, 0.0);
  roster.CountTask(1);
  roster.End(1);
  const std::vector<WorkerStatus> status = roster.Status(0.0);
  ASSERT_EQ(status.size(), 1U);
  EXPECT_EQ(status[0].tasks_done, 1U);
  EXPECT_EQ(status[0].slots, 3U);
  EXPECT_FALSE(status[0].alive);
  EXPECT_EQ(roster.SessionOf("w"), std::nullopt);
}

}  // namespace
}  // namespace orbweave
