// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Many workers at one coordinator; bench/fleet_bench.cc is the same with more of all.

#include "tests/support/light_fleet.h"

#include <gtest/gtest.h>

#include "coordinator/coordinator.h"
#include "coordinator/grpc/grpc_server.h"
#include "tests/support/command.h"

namespace orbweave {
namespace {

TEST(LightFleet, LosesAndDoublesNoTask) {
  constexpr uint32_t kWorkers = 50;
  constexpr size_t kParts = 600;
  const testing::TemporaryFolder folder;
  const SteadyClock clock;
  const auto coordinator = Coordinator::Open(
      {.state_dir = folder / "state", .lease_s = 60.0, .find_plan = testing::FindWidePlan}, clock);
  ASSERT_TRUE(coordinator.ok()) << coordinator.status();
  const auto server = GrpcServer::Start(**coordinator, "unix:" + (folder / "s"));
  ASSERT_TRUE(server.ok()) << server.status();
  const std::vector<Digest> recipes = testing::WideRecipes(0, kParts);
  {
    testing::LightFleet fleet(folder / "s", folder.Path(), kWorkers, 0.05);
    const auto job = (*coordinator)->SubmitJob(*testing::PrepareWideJob(**coordinator, recipes));
    ASSERT_TRUE(job.ok()) << job.status();
    ASSERT_TRUE(testing::WaitUntil(
        [&] { return (*coordinator)->GetJob(*job)->state == JobState::kDone; }, 200.0));
    const auto faults = testing::FaultsOf(**coordinator, *job, recipes, fleet.runs());
    ASSERT_TRUE(faults.ok()) << faults.status();
    EXPECT_EQ(faults->lost, 0U);
    EXPECT_EQ(faults->doubled, 0U);
    EXPECT_EQ(fleet.refused(), 0U);
    EXPECT_EQ((*coordinator)->GetJob(*job)->stages[0].retries, 0U);
    uint32_t done = 0;
    const auto workers = (*coordinator)->ListWorkers();
    for (const WorkerStatus& worker : *workers) done += worker.tasks_done;
    EXPECT_EQ(done, kParts);
    EXPECT_EQ(workers->size(), kWorkers);
  }
  (*coordinator)->BeginShutdown();
}

}  // namespace
}  // namespace orbweave
