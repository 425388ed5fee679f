// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/machine_offers.h"

#include <gtest/gtest.h>

#include "tests/support/command.h"

namespace orbweave {
namespace {

using testing::TemporaryFolder;
using testing::WriteAll;

TEST(OffersOfMachine, KnowsTheMemoryOfThisOne) {
  const uint64_t bytes = OffersOfMachine().memory_bytes;
  EXPECT_GE(bytes, uint64_t{64} << 20);
  EXPECT_LE(bytes, uint64_t{1} << 50);
}

TEST(OffersOfMachine, SaysNothingOfWhatIsNotFound) {
  const TemporaryFolder folder;
  EXPECT_EQ(OffersOfMachine(folder.Path()), WorkerOffers{});
}

TEST(OffersOfMachine, AControlGroupLeavesLess) {
  const TemporaryFolder folder;
  WriteAll(folder / "proc/meminfo", "MemTotal:       1000 kB\nMemFree:  10 kB\n");
  EXPECT_EQ(OffersOfMachine(folder.Path()).memory_bytes, 1'024'000U);
  WriteAll(folder / "sys/fs/cgroup/memory.max", "max\n");
  EXPECT_EQ(OffersOfMachine(folder.Path()).memory_bytes, 1'024'000U);
  WriteAll(folder / "sys/fs/cgroup/memory.max", "4096\n");
  EXPECT_EQ(OffersOfMachine(folder.Path()).memory_bytes, 4096U);
  WriteAll(folder / "sys/fs/cgroup/memory.max", "9223372036854771712\n");
  EXPECT_EQ(OffersOfMachine(folder.Path()).memory_bytes, 1'024'000U) << "more than there is";
}

TEST(OffersOfMachine, CountsDevicesFromTheFirstOn) {
  const TemporaryFolder folder;
  for (const char* name : {"dev/nvidia0", "dev/nvidia1", "dev/nvidia3", "dev/nvidiactl"})
    WriteAll(folder / name, "");
  EXPECT_EQ(OffersOfMachine(folder.Path()).gpus, 2U);
}

TEST(ShareOf, AllSharesTogetherAreNoMoreThanTheMachine) {
  const WorkerOffers machine{.memory_bytes = 1000, .threads = 16, .gpus = 5};
  WorkerOffers sum;
  for (uint32_t k = 0; k < 3; ++k) {
    const WorkerOffers share = ShareOf(machine, k, 3);
    sum.memory_bytes += share.memory_bytes;
    sum.threads += share.threads;
    sum.gpus += share.gpus;
  }
  EXPECT_EQ(sum, (WorkerOffers{.memory_bytes = 999, .threads = 15, .gpus = 5}));
  EXPECT_EQ(ShareOf(machine, 0, 1), machine);
}

}  // namespace
}  // namespace orbweave
