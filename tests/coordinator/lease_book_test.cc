// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/lease_book.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

const Digest kTask = DigestOf("task");

LeaseEntry Entry(uint64_t epoch, uint64_t session, double until_s) {
  return {.epoch = epoch,
          .task = kTask,
          .job = DigestOf("job"),
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

TEST(LeaseBook, StrikesOutAllLeasesOfATask) {
  LeaseBook book;
  book.Grant(Entry(1, 10, 5.0));
  book.Grant(Entry(2, 11, 5.0));
  LeaseEntry sibling = Entry(3, 10, 5.0);
  sibling.ref.part = 1;
  book.Grant(sibling);
  EXPECT_EQ(book.TakeTask(DigestOf("job"), {}).size(), 2U);
  EXPECT_EQ(book.TakeTask(DigestOf("other job"), sibling.ref).size(), 0U);
  EXPECT_TRUE(book.Take(3, kTask, 10).ok());
}

TEST(LeaseBook, VoidsASessionOrAJobWhole) {
  LeaseBook book;
  book.Grant(Entry(1, 10, 5.0));
  book.Grant(Entry(2, 11, 5.0));
  book.Grant(Entry(3, 10, 5.0));
  EXPECT_EQ(book.TakeSession(10).size(), 2U);
  book.DropJob(DigestOf("job"));
  EXPECT_TRUE(book.TakeSession(11).empty());
}

}  // namespace
}  // namespace orbweave
