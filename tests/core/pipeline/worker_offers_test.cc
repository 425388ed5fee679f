// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/worker_offers.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

constexpr uint64_t kGiB = uint64_t{1} << 30;

TEST(TasksAtOnce, WhatStatesNothingHasATaskOfOneThreadInEverySlot) {
  EXPECT_EQ(TasksAtOnce({}, 3, {}), 3U);
  EXPECT_EQ(TasksAtOnce({}, 3, {.memory_bytes = 1000 * kGiB}), 3U) << "nobody knows its memory";
  EXPECT_EQ(TasksAtOnce({}, 3, {.threads = 2}), 1U);
  EXPECT_EQ(TasksAtOnce({}, 3, {.threads = 4}), 0U);
  EXPECT_EQ(TasksAtOnce({}, 3, {.gpus = 1}), 0U);
}

TEST(TasksAtOnce, TheScarcestThingDecides) {
  const WorkerOffers offers{.memory_bytes = 64 * kGiB, .threads = 16, .gpus = 2};
  EXPECT_EQ(TasksAtOnce(offers, 8, {}), 8U);
  EXPECT_EQ(TasksAtOnce(offers, 8, {.memory_bytes = 10 * kGiB}), 6U);
  EXPECT_EQ(TasksAtOnce(offers, 8, {.memory_bytes = 10 * kGiB, .threads = 4}), 4U);
  EXPECT_EQ(TasksAtOnce(offers, 8, {.memory_bytes = 10 * kGiB, .threads = 4, .gpus = 1}), 2U);
  EXPECT_EQ(TasksAtOnce(offers, 8, {.memory_bytes = 64 * kGiB + 1}), 0U);
}

TEST(HasRoom, AsManyTasksHaveRoomAsAtOnce) {
  const WorkerOffers offers{.memory_bytes = 64 * kGiB, .threads = 7, .gpus = 5};
  const StageNeeds needs{.memory_bytes = 9 * kGiB, .threads = 2, .gpus = 1};
  StageNeeds taken{.threads = 0};
  for (uint32_t tasks = 0; tasks < TasksAtOnce(offers, 8, needs); ++tasks) {
    EXPECT_TRUE(HasRoom(offers, 8, taken, needs)) << tasks;
    taken.memory_bytes += needs.memory_bytes;
    taken.threads += needs.threads;
    taken.gpus += needs.gpus;
  }
  EXPECT_FALSE(HasRoom(offers, 8, taken, needs));
}

TEST(HasRoom, ASlotOfItsOwnIsAThreadWhereNothingIsStated) {
  EXPECT_TRUE(HasRoom({}, 1, {.threads = 5}, {}));
  EXPECT_FALSE(HasRoom({}, 4, {.threads = 3}, {.threads = 2}));
  EXPECT_FALSE(HasRoom({.threads = 4}, 4, {.threads = 4}, {})) << "stated is stated";
}

TEST(HasRoom, NothingOverflows) {
  const uint64_t most = ~uint64_t{0};
  EXPECT_FALSE(HasRoom({.memory_bytes = 8}, 2, {.memory_bytes = 4}, {.memory_bytes = most}));
  EXPECT_FALSE(HasRoom({.memory_bytes = 8}, 2, {.memory_bytes = most}, {.memory_bytes = 4}));
}

TEST(DescribeMissing, NamesWhatIsAskedForAndWhatThereIs) {
  const std::vector<WorkerOffers> workers = {{.memory_bytes = 16 * kGiB, .threads = 4},
                                             {.memory_bytes = 8 * kGiB, .threads = 8}};
  EXPECT_EQ(DescribeMissing(workers, {.gpus = 1}), "1 GPU (no worker has any)");
  EXPECT_EQ(
      DescribeMissing(workers, {.memory_bytes = 64 * kGiB, .threads = 9}),
      "64 GiB of memory (the most a worker has is 16 GiB of memory) and 9 threads (the most a "
      "worker has is 8 threads)");
  EXPECT_EQ(DescribeMissing(workers, {.memory_bytes = 12 * kGiB, .threads = 6}),
            "12 GiB of memory and 6 threads (no worker has all of it)");
}

}  // namespace
}  // namespace orbweave
