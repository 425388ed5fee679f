// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Workers that share no folder, at parts of which neighbours read much of the same: how much goes
// over the wire.

#include <gtest/gtest.h>

#include "coordinator/coordinator.h"
#include "coordinator/grpc/grpc_server.h"
#include "core/base/random.h"
#include "tests/support/command.h"
#include "tests/support/light_fleet.h"

namespace orbweave {
namespace {

constexpr size_t kParts = 400;
constexpr size_t kWindow = 16;  ///< blobs that a part reads: its own and those of the next ones
constexpr uint32_t kWorkers = 8;
constexpr size_t kBlobBytes = 20'000;

/// Reads the window of its part, and takes a while that depends on nothing.
class WindowExecutor final : public TaskExecutor {
 public:
  WindowExecutor(const std::vector<Digest>& blobs, uint64_t seed) : blobs_(blobs), random_(seed) {}

  absl::StatusOr<TaskResult> Run(const TaskSpec& spec,
                                 TaskBlobs& blobs,
                                 const StageContext& /*context*/) override {
    for (size_t i = 0; i < kWindow; ++i)
      ORBWEAVE_RETURN_IF_ERROR(blobs.Get(blobs_[spec.part + i]).status());
    std::this_thread::sleep_for(std::chrono::microseconds(5'000 + random_.Index(10'000)));
    return TaskResult{.report_json = "{}"};
  }

 private:
  const std::vector<Digest>& blobs_;
  Random random_;
};

TEST(Locality, NeighboursGoToWorkersThatHaveWhatTheyRead) {
  const testing::TemporaryFolder folder;
  const SteadyClock clock;
  const auto coordinator = Coordinator::Open(
      {.state_dir = folder / "state", .lease_s = 60.0, .find_plan = testing::FindWidePlan}, clock);
  ASSERT_TRUE(coordinator.ok()) << coordinator.status();
  const auto server = GrpcServer::Start(**coordinator, "unix:" + (folder / "s"));
  ASSERT_TRUE(server.ok()) << server.status();
  std::vector<Digest> blobs;
  for (size_t i = 0; i < kParts + kWindow; ++i)
    blobs.push_back(*(*coordinator)->Put(std::to_string(i) + std::string(kBlobBytes, 'x')));
  std::atomic<uint64_t> seed{0};
  {
    const testing::LightFleet fleet(folder / "s", folder.Path(), kWorkers, [&] {
      return std::make_unique<WindowExecutor>(blobs, ++seed);
    });
    const auto job =
        (*coordinator)
            ->SubmitJob(*testing::PrepareWideJob(**coordinator, testing::WideRecipes(0, kParts)));
    ASSERT_TRUE(job.ok()) << job.status();
    ASSERT_TRUE(testing::WaitUntil(
        [&] { return (*coordinator)->GetJob(*job)->state == JobState::kDone; }, 200.0));
  }
  const double all_bytes = static_cast<double>(blobs.size() * kBlobBytes);
  const double moved = static_cast<double>((*coordinator)->blob_traffic().bytes_out) / all_bytes;
  RecordProperty("moved_times_all_blobs", std::to_string(moved));
  EXPECT_GE(moved, 1.0);
  EXPECT_LT(moved, 3.5) << "one part after the other to whom asks first: 8 times";
  (*coordinator)->BeginShutdown();
}

}  // namespace
}  // namespace orbweave
