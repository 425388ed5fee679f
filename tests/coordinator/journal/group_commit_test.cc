// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/group_commit.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace orbweave {
namespace {

/// Runs its writes; holds the first batch until all `expected` writers have come.
struct SlowFirst {
  std::atomic<int>& started;
  int expected;
  std::vector<size_t>& batches;

  absl::Status operator()(const std::vector<const GroupCommit::Write*>& writes) const {
    while (batches.empty() && started.load() < expected) std::this_thread::yield();
    if (batches.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    batches.push_back(writes.size());
    absl::Status status;
    for (const GroupCommit::Write* write : writes) status.Update((*write)());
    return status;
  }
};

TEST(GroupCommit, WhoComesDuringACommitSharesTheNext) {
  constexpr int kWriters = 9;
  std::atomic<int> started{0};
  std::atomic<int> written{0};
  std::vector<size_t> batches;
  GroupCommit commit(SlowFirst{started, kWriters, batches});
  std::vector<std::jthread> writers;
  for (int i = 0; i < kWriters; ++i) {
    writers.emplace_back([&] {
      ++started;
      EXPECT_TRUE(commit
                      .Commit([&written] {
                        ++written;
                        return absl::OkStatus();
                      })
                      .ok());
    });
  }
  writers.clear();
  EXPECT_EQ(written.load(), kWriters);
  size_t sum = 0;
  for (const size_t batch : batches) sum += batch;
  EXPECT_EQ(sum, static_cast<size_t>(kWriters)) << "every write once";
  EXPECT_LT(batches.size(), static_cast<size_t>(kWriters)) << "some shared a transaction";
}

TEST(GroupCommit, TellsWhatBecameOfTheTransaction) {
  GroupCommit commit([](const auto& writes) {
    for (const auto* write : writes) ORBWEAVE_RETURN_IF_ERROR((*write)());
    return absl::UnavailableError("cannot commit");
  });
  EXPECT_TRUE(absl::IsUnavailable(commit.Commit([] { return absl::OkStatus(); })));
  EXPECT_TRUE(absl::IsInternal(commit.Commit([] { return absl::InternalError("no"); })));
}

}  // namespace
}  // namespace orbweave
