// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/jobs/lease_book.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "core/base/random.h"

namespace orbweave {
namespace {

const Digest kTask = DigestOf("task");

LeaseEntry Entry(uint64_t epoch, uint64_t session, double until_s) {
  return {.epoch = epoch,
          .task = kTask,
          .job = DigestOf("job"),
          .ref = TaskRef{},
          .worker = "w",
          .session = session,
          .until_s = until_s};
}

TEST(LeaseBook, TakesALeaseOnce) {
  LeaseBook book;
  book.Grant(Entry(1, 10, 5.0));
  EXPECT_TRUE(book.Take(1, kTask, 10).ok());
  EXPECT_TRUE(absl::IsFailedPrecondition(book.Take(1, kTask, 10).status()));
}

TEST(LeaseBook, RefusesAnotherEpochTaskOrSession) {
  LeaseBook book;
  book.Grant(Entry(2, 10, 5.0));
  EXPECT_TRUE(absl::IsFailedPrecondition(book.Take(1, kTask, 10).status()));
  EXPECT_TRUE(absl::IsFailedPrecondition(book.Take(2, DigestOf("other"), 10).status()));
  EXPECT_TRUE(absl::IsFailedPrecondition(book.Take(2, kTask, 11).status()));
  EXPECT_EQ(book.Renew(1, kTask, 10, 9.0), nullptr);
  EXPECT_EQ(book.Renew(2, kTask, 11, 9.0), nullptr);
}

TEST(LeaseBook, ExpiresWhatWasNotRenewed) {
  LeaseBook book;
  book.Grant(Entry(1, 10, 5.0));
  book.Grant(Entry(2, 11, 5.0));
  ASSERT_NE(book.Renew(2, kTask, 11, 9.0), nullptr);
  EXPECT_TRUE(book.TakeExpired(5.0).empty());
  const std::vector<LeaseEntry> expired = book.TakeExpired(6.0);
  ASSERT_EQ(expired.size(), 1U);
  EXPECT_EQ(expired[0].epoch, 1U);
  EXPECT_EQ(book.TakeExpired(100.0).size(), 1U);
}

TEST(LeaseBook, KnowsEndsAndSlotsAsALookAtAllLeasesWould) {
  Random random(5);
  LeaseBook book;
  std::map<uint64_t, LeaseEntry> all;
  double now_s = 0.0;
  for (uint64_t epoch = 1; epoch < 2000; ++epoch) {
    LeaseEntry entry = Entry(epoch, 1, now_s + random.Uniform(0.0, 20.0));
    entry.slot = random.Index(7);
    all.emplace(epoch, entry);
    book.Grant(entry);
    const auto other = std::next(
        all.begin(), static_cast<ptrdiff_t>(random.Index(static_cast<uint32_t>(all.size()))));
    if (epoch % 3 == 0) {
      other->second.until_s = now_s + random.Uniform(0.0, 20.0);
      EXPECT_NE(book.Renew(other->first, kTask, 1, other->second.until_s), nullptr);
    } else if (epoch % 3 == 1) {
      EXPECT_TRUE(book.Take(other->first, kTask, 1).ok());
      all.erase(other);
    }
    now_s += random.Uniform(0.0, 0.5);
    const size_t expired =
        std::erase_if(all, [now_s](const auto& item) { return item.second.until_s < now_s; });
    ASSERT_EQ(book.TakeExpired(now_s).size(), expired) << epoch;
    for (uint32_t slot = 0; slot < 7; ++slot) {
      const auto is_there = [slot](const auto& item) { return item.second.slot == slot; };
      ASSERT_EQ(static_cast<ptrdiff_t>(book.CountAt({"w", slot})),
                std::ranges::count_if(all, is_there))
          << epoch;
    }
  }
}

TEST(LeaseBook, StrikesOutAllLeasesOfATask) {
  LeaseBook book;
  book.Grant(Entry(1, 10, 5.0));
  book.Grant(Entry(2, 11, 5.0));
  LeaseEntry sibling = Entry(3, 10, 5.0);
  sibling.ref->part = 1;
  book.Grant(sibling);
  EXPECT_EQ(book.TakeTask(DigestOf("job"), {}).size(), 2U);
  EXPECT_EQ(book.TakeTask(DigestOf("other job"), *sibling.ref).size(), 0U);
  EXPECT_TRUE(book.Take(3, kTask, 10).ok());
}

TEST(LeaseBook, VoidsASessionOrAJobWhole) {
  LeaseBook book;
  book.Grant(Entry(1, 10, 5.0));
  book.Grant(Entry(2, 11, 5.0));
  book.Grant(Entry(3, 10, 5.0));
  EXPECT_EQ(book.TakeSession(10).size(), 2U);
  EXPECT_EQ(book.TakeJob(DigestOf("job")).size(), 1U);
  EXPECT_TRUE(book.TakeSession(11).empty());
}

TEST(LeaseBook, AWorkerThatJoinsKeepsWhatItListsAndNothingElse) {
  LeaseBook book;
  book.Grant(Entry(1, 10, 5.0));
  book.Grant(Entry(2, 0, 5.0));
  book.Grant(Entry(3, 0, 5.0));
  LeaseEntry of_another = Entry(4, 0, 5.0);
  of_another.worker = "other";
  book.Grant(of_another);
  const std::vector<LeaseEntry> lost =
      book.Adopt("w", {{kTask, 2, {}}, {DigestOf("other"), 3, {}}, {kTask, 4, {}}}, 11, 9.0);
  ASSERT_EQ(lost.size(), 2U);
  EXPECT_EQ(lost[0].epoch, 1U);
  EXPECT_EQ(lost[1].epoch, 3U);
  EXPECT_TRUE(absl::IsFailedPrecondition(book.Take(4, kTask, 11).status()));
  EXPECT_EQ(book.TakeExpired(6.0).size(), 1U) << "the other worker's";
  EXPECT_TRUE(book.Take(2, kTask, 11).ok());
}

TEST(LeaseBook, FindsLeasesThatHaveNoPlaceInTheirJobYet) {
  LeaseBook book;
  book.Grant(Entry(1, 10, 5.0));
  LeaseEntry awaited = Entry(2, 0, 5.0);
  awaited.ref.reset();
  book.Grant(awaited);
  EXPECT_TRUE(book.AwaitingPlace(DigestOf("other job")).empty());
  const std::vector<LeaseEntry*> found = book.AwaitingPlace(DigestOf("job"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0]->epoch, 2U);
  found[0]->ref = TaskRef{0, 1};
  EXPECT_TRUE(book.AwaitingPlace(DigestOf("job")).empty());
}

/// A lease of a task of its own at w's first slot.
LeaseEntry AtTheSlot(uint64_t epoch, double until_s = 5.0) {
  LeaseEntry entry = Entry(epoch, 10, until_s);
  entry.task = DigestOf(std::to_string(epoch));
  entry.job = DigestOf("job " + std::to_string(epoch));
  return entry;
}

std::vector<bool> WhoWaits(const std::vector<LeaseEntry>& entries) {
  std::vector<bool> waits;
  for (const LeaseEntry& entry : entries) waits.push_back(entry.waits);
  return waits;
}

TEST(LeaseBook, ALaterLeaseOfASlotWaits) {
  LeaseBook book;
  book.Grant(AtTheSlot(1));
  book.Grant(AtTheSlot(2));
  LeaseEntry elsewhere = AtTheSlot(3);
  elsewhere.slot = 1;
  book.Grant(elsewhere);
  EXPECT_EQ(WhoWaits(book.TakeSession(10)), (std::vector<bool>{false, true, false}));
}

TEST(LeaseBook, ALeaseBeginsWhenTheOneBeforeIsDoneOrVoid) {
  LeaseBook book;
  book.Grant(AtTheSlot(1));
  book.Grant(AtTheSlot(2));
  ASSERT_TRUE(book.Take(1, AtTheSlot(1).task, 10).ok());
  book.Grant(AtTheSlot(3));
  EXPECT_EQ(WhoWaits(book.TakeJob(AtTheSlot(2).job)), (std::vector<bool>{false}));
  EXPECT_EQ(WhoWaits(book.TakeSession(10)), (std::vector<bool>{false}));
}

TEST(LeaseBook, WhatWaitedOnASilentWorkerHadNotBegun) {
  LeaseBook book;
  book.Grant(AtTheSlot(1, 5.0));
  book.Grant(AtTheSlot(2, 6.0));
  EXPECT_EQ(WhoWaits(book.TakeExpired(5.5)), (std::vector<bool>{false}));
  EXPECT_EQ(WhoWaits(book.TakeExpired(6.5)), (std::vector<bool>{true}));
}

}  // namespace
}  // namespace orbweave
