// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/worker_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <thread>

#include "coordinator/coordinator.h"
#include "coordinator/grpc/grpc_server.h"
#include "tests/support/command.h"
#include "tests/support/in_process_executor.h"
#include "tests/support/toy_job.h"
#include "tests/support/wait_for_end.h"
#include "worker/grpc_coordinator_client.h"

namespace orbweave {
namespace {

using testing::FindToyPlan;
using testing::LookupIn;
using testing::PrepareToyJob;
using testing::TemporaryFolder;
using testing::ToyAnswer;
using testing::ToyStages;
using testing::WaitForEnd;
using testing::WaitUntil;

std::unique_ptr<Coordinator> OpenCoordinator(const std::string& state,
                                             const Clock& clock,
                                             double lease_s = 20.0) {
  auto opened = Coordinator::Open({.state_dir = state,
                                   .lease_s = lease_s,
                                   .retry = {.first_wait_s = 0.05},
                                   .find_plan = FindToyPlan},
                                  clock);
  ORBWEAVE_CHECK(opened.ok());
  return *std::move(opened);
}

/// A worker on a thread of its own, stopped when it goes.
class RunningWorker {
 public:
  RunningWorker(CoordinatorApi& api,
                testing::StageMap stages,
                const std::string& name,
                uint32_t slots = 1,
                double grace_s = 0.0,
                const std::string& blob_folder = "")
      : RunningWorker(
            api,
            std::move(stages),
            WorkerOptions{
                .name = name, .slots = slots, .grace_s = grace_s, .blob_folder = blob_folder}) {}
  RunningWorker(CoordinatorApi& api, testing::StageMap stages, WorkerOptions options)
      : stages_(std::move(stages)), options_(std::move(options)) {
    options_.poll_s = 0.1;
    thread_ = std::thread([this, &api] {
      const StageLookup lookup = LookupIn(stages_);
      end_ =
          RunWorker(api, api, testing::RunInProcess(lookup, clock_), options_, stop_.get_token());
    });
  }
  ~RunningWorker() { (void)Stop(); }
  RunningWorker(const RunningWorker&) = delete;
  RunningWorker& operator=(const RunningWorker&) = delete;

  void RequestStop() { stop_.request_stop(); }
  /// Waits for its end; how it ended.
  absl::StatusOr<WorkerEnd> End() {
    if (thread_.joinable()) thread_.join();
    return end_;
  }
  absl::Status Join() { return End().status(); }
  absl::Status Stop() {
    RequestStop();
    return Join();
  }

 private:
  testing::StageMap stages_;
  WorkerOptions options_;
  SteadyClock clock_;
  std::stop_source stop_;
  absl::StatusOr<WorkerEnd> end_ = absl::UnknownError("never ran");
  std::thread thread_;
};

class WorkerLoopTest : public ::testing::Test {
 protected:
  Digest Submit(CoordinatorApi& api,
                const std::string& numbers,
                const std::string& options_text = "") {
    return *api.SubmitJob(*PrepareToyJob(api, numbers, options_text));
  }

  TemporaryFolder folder_;
  SteadyClock clock_;
};

TEST_F(WorkerLoopTest, DoesAJobWithSeveralWorkersAndSlots) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_);
  RunningWorker one(*coordinator, ToyStages(), "one");
  RunningWorker two(*coordinator, ToyStages(), "two", 3);
  const Digest job = Submit(*coordinator, "1 2 3 4 5 6 7 8 9 10");
  EXPECT_EQ(WaitForEnd(*coordinator, job)->state, JobState::kDone);
  EXPECT_EQ(*ToyAnswer(*coordinator, job), "385");
  EXPECT_TRUE(one.Stop().ok());
  EXPECT_TRUE(two.Stop().ok());
  const auto workers = coordinator->ListWorkers();
  for (const WorkerStatus& worker : *workers) EXPECT_FALSE(worker.alive) << worker.name;
}

TEST_F(WorkerLoopTest, TakesQuickTasksAheadAndRunsThemOneAfterAnother) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_);
  std::atomic<int> running = 0;
  std::atomic<bool> overlap = false;
  std::atomic<bool> held_two = false;
  Digest job;
  testing::StageMap stages = ToyStages();
  stages["square"] = [&](const TaskSpec& spec, BlobAccess& blobs, const StageContext& context) {
    if (++running > 1) overlap = true;
    const auto holds_two = [&] { return coordinator->GetJob(job)->stages[1].tasks_running == 2; };
    if (!held_two && spec.part > 0) held_two = WaitUntil(holds_two, 0.1);
    const auto result = testing::Square(spec, blobs, context);
    --running;
    return result;
  };
  job = Submit(*coordinator, "1 2 3 4 5 6 7 8 9 10");
  RunningWorker worker(*coordinator, stages, "w");
  EXPECT_EQ(WaitForEnd(*coordinator, job)->state, JobState::kDone);
  EXPECT_EQ(*ToyAnswer(*coordinator, job), "385");
  EXPECT_FALSE(overlap);
  EXPECT_TRUE(held_two);
}

TEST_F(WorkerLoopTest, HandsInOnlyWhatIsStoredAndBeginsTheNextTaskMeanwhile) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_);
  const std::string store = folder_ / "blobs/tmp";
  std::atomic<uint32_t> begun = 0;
  testing::StageMap stages = ToyStages();
  stages["square"] = [&](const TaskSpec& spec, BlobAccess& blobs, const StageContext& context) {
    if (++begun == 2) {  // after the first, the stage is known to be quick
      std::filesystem::rename(store, store + ".away");
      std::ofstream(store) << "no folder";
    }
    return testing::Square(spec, blobs, context);
  };
  const Digest job = Submit(*coordinator, "2 3 5");
  RunningWorker worker(*coordinator, stages, "w");
  EXPECT_TRUE(WaitUntil([&] { return begun == 3; }, 20.0));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(coordinator->GetJob(job)->stages[1].tasks_done, 1U);
  std::filesystem::remove(store);
  std::filesystem::rename(store + ".away", store);
  EXPECT_EQ(WaitForEnd(*coordinator, job)->state, JobState::kDone);
  EXPECT_EQ(*ToyAnswer(*coordinator, job), "38");
  EXPECT_EQ(coordinator->GetJob(job)->stages[1].retries, 0U);
}

/// A store whose blobs the coordinator sees a while later, as folders that are shared over a
/// network have it.
class LateBlobs final : public BlobAccess {
 public:
  LateBlobs(BlobAccess& store, double lag_s) : store_(store), lag_s_(lag_s) {}
  ~LateBlobs() override {
    for (std::thread& writer : writers_) writer.join();
  }
  absl::StatusOr<std::string> Get(const Digest& digest) override { return store_.Get(digest); }
  absl::StatusOr<Digest> Put(std::string_view bytes) override {
    const std::lock_guard lock(mutex_);
    writers_.emplace_back([this, late = std::string(bytes)] {
      std::this_thread::sleep_for(std::chrono::duration<double>(lag_s_));
      (void)store_.Put(late);
    });
    return DigestOf(bytes);
  }

 private:
  BlobAccess& store_;
  double lag_s_ = 0.0;
  std::mutex mutex_;
  std::vector<std::thread> writers_;
};

TEST_F(WorkerLoopTest, WaitsForBlobsThatTheCoordinatorDoesNotSeeYet) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_);
  const Digest job = Submit(*coordinator, "2");
  testing::StageMap stages = ToyStages();
  LateBlobs blobs(*coordinator, 0.7);
  std::stop_source stop;
  std::thread worker([&] {
    const StageLookup lookup = LookupIn(stages);
    (void)RunWorker(*coordinator,
                    blobs,
                    testing::RunInProcess(lookup, clock_),
                    {.name = "w", .slots = 1, .poll_s = 0.1},
                    stop.get_token());
  });
  EXPECT_EQ(WaitForEnd(*coordinator, job)->state, JobState::kDone);
  EXPECT_EQ(*ToyAnswer(*coordinator, job), "4");
  EXPECT_EQ(coordinator->GetJob(job)->stages[1].retries, 0U);
  stop.request_stop();
  worker.join();
}

TEST_F(WorkerLoopTest, ReadsAndWritesInTheFolderThatItShares) {
  const std::string address = "unix:" + (folder_ / "s");
  const auto coordinator = OpenCoordinator(folder_ / "state", clock_);
  const auto server = *GrpcServer::Start(*coordinator, address);
  GrpcCoordinatorClient client(address);
  const Digest job = Submit(*coordinator, "2 3 5");
  const BlobTraffic before = coordinator->blob_traffic();
  RunningWorker worker(client, ToyStages(), "w", 1, 0.0, folder_ / "state/blobs");
  EXPECT_EQ(WaitForEnd(*coordinator, job)->state, JobState::kDone);
  const BlobTraffic after = coordinator->blob_traffic();
  EXPECT_EQ(*ToyAnswer(*coordinator, job), "38");
  EXPECT_EQ(after.bytes_in, before.bytes_in);
  EXPECT_LE(after.bytes_out, before.bytes_out + 100) << "the check, and no more";
}

TEST_F(WorkerLoopTest, EndsWhereTheFolderIsAnothers) {
  const auto coordinator = OpenCoordinator(folder_ / "state", clock_);
  const auto other = OpenCoordinator(folder_ / "other", clock_);
  RunningWorker worker(*coordinator, ToyStages(), "w", 1, 0.0, folder_ / "other/blobs");
  EXPECT_TRUE(absl::IsFailedPrecondition(worker.Join()));
}

TEST_F(WorkerLoopTest, GivesARunningTaskBackWhenStopped) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_);
  const Digest job = Submit(*coordinator, "1", "toy.slow=true\n");
  const auto is_squaring = [&] { return coordinator->GetJob(job)->stages[1].tasks_running == 1; };
  {
    RunningWorker leaver(*coordinator, ToyStages(), "leaver");
    ASSERT_TRUE(WaitUntil(is_squaring, 20.0));
    EXPECT_TRUE(leaver.Stop().ok());
  }
  const auto status = coordinator->GetJob(job);
  EXPECT_EQ(status->state, JobState::kRunning);
  EXPECT_EQ(status->stages[1].tasks_running, 0U);
  EXPECT_EQ(status->stages[1].retries, 0U);
  RunningWorker next(*coordinator, ToyStages(), "next");
  EXPECT_TRUE(WaitUntil(is_squaring, 20.0));
}

TEST_F(WorkerLoopTest, FinishesWhatRunsWithinTheGrace) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_);
  const Digest job = Submit(*coordinator, "1 2 3 4 5 6 7 8 9 10", "toy.pause=true\n");
  // That a task is leased is not enough: its lease may still be on its way, and goes back then.
  std::atomic<bool> has_begun{false};
  auto stages = ToyStages();
  stages["square"] = [&](const TaskSpec& spec, BlobAccess& blobs, const StageContext& context) {
    has_begun = true;
    return testing::Square(spec, blobs, context);
  };
  RunningWorker leaver(*coordinator, stages, "leaver", 1, 20.0);
  ASSERT_TRUE(WaitUntil([&] { return has_begun.load(); }, 20.0));
  EXPECT_TRUE(leaver.Stop().ok());
  const StageStatus left = coordinator->GetJob(job)->stages[1];
  EXPECT_GT(left.tasks_done, 0U) << "what ran";
  EXPECT_LT(left.tasks_done, 10U) << "and no more";
  EXPECT_EQ(left.retries, 0U);
}

TEST_F(WorkerLoopTest, GivesBackWhatOutlastsTheGrace) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_);
  const Digest job = Submit(*coordinator, "1", "toy.slow=true\n");
  RunningWorker leaver(*coordinator, ToyStages(), "leaver", 1, 0.3);
  ASSERT_TRUE(
      WaitUntil([&] { return coordinator->GetJob(job)->stages[1].tasks_running == 1; }, 20.0));
  EXPECT_TRUE(leaver.Stop().ok());
  EXPECT_EQ(coordinator->GetJob(job)->stages[1].retries, 0U);
}

TEST_F(WorkerLoopTest, LeavesWhenItIsDrained) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_);
  const Digest job = Submit(*coordinator, "1 2 3 4 5 6 7 8 9 10", "toy.pause=true\n");
  RunningWorker leaver(*coordinator, ToyStages(), "leaver");
  ASSERT_TRUE(
      WaitUntil([&] { return coordinator->GetJob(job)->stages[1].tasks_running == 1; }, 20.0));
  ASSERT_TRUE(coordinator->DrainWorkers("leaver").ok());
  EXPECT_TRUE(leaver.Join().ok());
  const StageStatus left = coordinator->GetJob(job)->stages[1];
  EXPECT_GT(left.tasks_done, 0U) << "what ran";
  EXPECT_LT(left.tasks_done, 10U) << "and no more";
  EXPECT_EQ(left.retries, 0U);
}

TEST_F(WorkerLoopTest, TheGraceAlsoEndsAWorkerThatIsDrained) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_);
  const Digest job = Submit(*coordinator, "1", "toy.slow=true\n");
  RunningWorker leaver(*coordinator, ToyStages(), "leaver", 2, 0.1);
  ASSERT_TRUE(
      WaitUntil([&] { return coordinator->GetJob(job)->stages[1].tasks_running == 1; }, 20.0));
  ASSERT_TRUE(coordinator->DrainWorkers("leaver").ok());
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(coordinator->GetJob(job)->stages[1].tasks_running, 1U);
  EXPECT_TRUE(leaver.Stop().ok());
  EXPECT_EQ(coordinator->GetJob(job)->stages[1].tasks_running, 0U);
}

TEST_F(WorkerLoopTest, SaysWhyItLeft) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_, 2.0);
  RunningWorker stopped(*coordinator, ToyStages(), "stopped");
  stopped.RequestStop();
  EXPECT_EQ(*stopped.End(), WorkerEnd::kStopped);
  RunningWorker drained(*coordinator, ToyStages(), "drained");
  ASSERT_TRUE(WaitUntil([&] { return coordinator->DrainWorkers("drained").ok(); }, 20.0));
  EXPECT_EQ(*drained.End(), WorkerEnd::kDismissed);
  RunningWorker dismissed(*coordinator, ToyStages(), "dismissed");
  const Digest job = Submit(*coordinator, "1");
  EXPECT_EQ(WaitForEnd(*coordinator, job)->state, JobState::kDone);
  coordinator->BeginShutdown();
  EXPECT_EQ(*dismissed.End(), WorkerEnd::kDismissed);
}

TEST_F(WorkerLoopTest, EndsWhenItWasIdleForLong) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_, 2.0);
  const Digest job = Submit(*coordinator, "1 2 3", "toy.pause=true\n");
  RunningWorker worker(
      *coordinator, ToyStages(), {.name = "w", .slots = 2, .term = {.idle_s = 0.3}});
  EXPECT_EQ(*worker.End(), WorkerEnd::kIdle);
  EXPECT_EQ(coordinator->GetJob(job)->state, JobState::kDone) << "it was not idle before";
}

TEST_F(WorkerLoopTest, IsNotIdleWhileItsCoordinatorIsAway) {
  const std::string address = "unix:" + (folder_ / "s");
  GrpcCoordinatorClient client(address);
  RunningWorker worker(client, ToyStages(), {.name = "w", .term = {.idle_s = 1.0}});
  std::this_thread::sleep_for(std::chrono::seconds(2));
  const auto coordinator = OpenCoordinator(folder_ / "state", clock_, 2.0);
  const auto server = *GrpcServer::Start(*coordinator, address);
  const Digest job = Submit(*coordinator, "1");
  EXPECT_EQ(WaitForEnd(*coordinator, job)->state, JobState::kDone);
  EXPECT_EQ(*worker.End(), WorkerEnd::kIdle);
}

TEST_F(WorkerLoopTest, GivesUpACoordinatorThatStaysAway) {
  GrpcCoordinatorClient nobody("unix:" + (folder_ / "s"));
  RunningWorker worker(nobody, ToyStages(), {.name = "w", .term = {.patience_s = 0.5}});
  const absl::Status end = worker.Join();
  EXPECT_TRUE(absl::IsUnavailable(end)) << end;
  EXPECT_THAT(std::string(end.message()),
              ::testing::HasSubstr("no coordinator answered for 0.5 s"));
}

TEST_F(WorkerLoopTest, GivesUpACoordinatorThatGoesForLongWithATaskInHand) {
  const std::string address = "unix:" + (folder_ / "s");
  auto coordinator = OpenCoordinator(folder_ / "state", clock_);
  auto server = *GrpcServer::Start(*coordinator, address);
  GrpcCoordinatorClient client(address);
  const Digest job = Submit(*coordinator, "1", "toy.slow=true\n");
  RunningWorker worker(client, ToyStages(), {.name = "w", .term = {.patience_s = 2.0}});
  ASSERT_TRUE(
      WaitUntil([&] { return coordinator->GetJob(job)->stages[1].tasks_running == 1; }, 20.0));
  server.reset();  // as if the process had died: nobody is told
  coordinator.reset();
  EXPECT_TRUE(absl::IsUnavailable(worker.Join()));
}

TEST_F(WorkerLoopTest, FinishesWhatItHasWhenItsLifetimeIsOver) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_);
  std::atomic<int> begun{0};
  testing::StageMap stages = ToyStages();
  stages["square"] = [&begun](
                         const TaskSpec& spec, BlobAccess& blobs, const StageContext& context) {
    ++begun;
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    return testing::Square(spec, blobs, context);
  };
  const Digest job = Submit(*coordinator, "1 2 3 4 5 6 7 8 9 10");
  RunningWorker worker(*coordinator, stages, {.name = "w", .term = {.lifetime_s = 0.8}});
  EXPECT_EQ(*worker.End(), WorkerEnd::kStopped);
  const StageStatus left = coordinator->GetJob(job)->stages[1];
  EXPECT_EQ(left.tasks_done, static_cast<uint32_t>(begun.load())) << "nothing was given back";
  EXPECT_GT(begun, 0);
  EXPECT_LT(begun, 10);
  EXPECT_EQ(left.retries, 0U);
}

TEST_F(WorkerLoopTest, IsGoneWhenItsTimeIsUp) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_);
  const Digest job = Submit(*coordinator, "1", "toy.slow=true\n");
  RunningWorker worker(
      *coordinator, ToyStages(), {.name = "w", .grace_s = 0.5, .term = {.stays_s = 2.0}});
  ASSERT_TRUE(
      WaitUntil([&] { return coordinator->GetJob(job)->stages[1].tasks_running == 1; }, 20.0));
  EXPECT_EQ(*worker.End(), WorkerEnd::kStopped);
  const StageStatus left = coordinator->GetJob(job)->stages[1];
  EXPECT_EQ(left.tasks_running, 0U) << "it was given back";
  EXPECT_EQ(left.retries, 0U);
}

TEST_F(WorkerLoopTest, StopsATaskOfACancelledJobAndTakesTheNext) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_, 2.0);
  RunningWorker worker(*coordinator, ToyStages(), "w");
  const Digest slow = Submit(*coordinator, "1", "toy.slow=true\n");
  ASSERT_TRUE(
      WaitUntil([&] { return coordinator->GetJob(slow)->stages[1].tasks_running == 1; }, 20.0));
  ASSERT_TRUE(coordinator->CancelJob(slow).ok());
  const Digest quick = Submit(*coordinator, "2");
  EXPECT_EQ(WaitForEnd(*coordinator, quick)->state, JobState::kDone);
}

TEST_F(WorkerLoopTest, RetriesWhatFailedForAWhile) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_);
  std::atomic<int> attempts{0};
  testing::StageMap stages = ToyStages();
  stages["split"] = [&attempts](
                        const TaskSpec& spec, BlobAccess& blobs, const StageContext& context) {
    if (++attempts < 3) throw std::runtime_error("solver crashed");
    return testing::Split(spec, blobs, context);
  };
  RunningWorker worker(*coordinator, stages, "w");
  const Digest job = Submit(*coordinator, "1 2");
  EXPECT_EQ(WaitForEnd(*coordinator, job)->state, JobState::kDone);
  EXPECT_EQ(coordinator->GetJob(job)->stages[0].retries, 2U);
}

TEST_F(WorkerLoopTest, ReportsAPermanentErrorOnce) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_);
  std::atomic<int> attempts{0};
  testing::StageMap stages = ToyStages();
  stages["split"] =
      [&attempts](const TaskSpec&, BlobAccess&, const StageContext&) -> absl::StatusOr<TaskResult> {
    ++attempts;
    return absl::InvalidArgumentError("no numbers");
  };
  RunningWorker worker(*coordinator, stages, "w");
  const Digest job = Submit(*coordinator, "1 2");
  EXPECT_EQ(WaitForEnd(*coordinator, job)->state, JobState::kFailed);
  EXPECT_THAT(coordinator->GetJob(job)->error, ::testing::HasSubstr("no numbers"));
  EXPECT_EQ(attempts.load(), 1);
}

TEST_F(WorkerLoopTest, ReportsProgressWithItsHeartbeats) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_, 2.0);
  RunningWorker worker(*coordinator, ToyStages(), "w");
  const Digest job = Submit(*coordinator, "1", "toy.slow=true\n");
  EXPECT_TRUE(
      WaitUntil([&] { return coordinator->GetJob(job)->stages[1].fraction_running == 0.5; }, 20.0));
}

TEST_F(WorkerLoopTest, LeavesWhenTheCoordinatorShutsDown) {
  const auto coordinator = OpenCoordinator(folder_.Path(), clock_, 2.0);
  RunningWorker worker(*coordinator, ToyStages(), "w");
  const Digest job = Submit(*coordinator, "1");
  EXPECT_EQ(WaitForEnd(*coordinator, job)->state, JobState::kDone);
  coordinator->BeginShutdown();
  EXPECT_TRUE(worker.Join().ok());
}

TEST_F(WorkerLoopTest, OutlastsACoordinatorThatIsStartedAgain) {
  const std::string address = "unix:" + (folder_ / "s");
  auto coordinator = OpenCoordinator(folder_ / "state", clock_);
  auto server = *GrpcServer::Start(*coordinator, address);
  std::stop_source stop;
  GrpcCoordinatorClient client(address);
  RunningWorker worker(client, ToyStages(), "w");
  const Digest first = Submit(*coordinator, "1 2");
  EXPECT_EQ(WaitForEnd(*coordinator, first)->state, JobState::kDone);
  server.reset();  // as if the process had died: nobody is told
  coordinator.reset();
  coordinator = OpenCoordinator(folder_ / "state", clock_);
  server = *GrpcServer::Start(*coordinator, address);
  const Digest second = Submit(*coordinator, "3 4");
  EXPECT_EQ(WaitForEnd(*coordinator, second)->state, JobState::kDone);
  EXPECT_EQ(*ToyAnswer(*coordinator, second), "25");
  worker.RequestStop();
  stop.request_stop();
  EXPECT_TRUE(worker.Join().ok());
  coordinator->BeginShutdown();
}

TEST_F(WorkerLoopTest, GoesOnWithItsTaskWhenTheCoordinatorIsStartedAgain) {
  const std::string address = "unix:" + (folder_ / "s");
  auto coordinator = OpenCoordinator(folder_ / "state", clock_);
  auto server = *GrpcServer::Start(*coordinator, address);
  std::stop_source stop;
  GrpcCoordinatorClient client(address);
  std::atomic<int> attempts{0};
  std::atomic<bool> may_end{false};
  testing::StageMap stages = ToyStages();
  stages["square"] = [&](const TaskSpec& spec, BlobAccess& blobs, const StageContext& context) {
    ++attempts;
    WaitUntil([&] { return may_end || context.stop.stop_requested(); }, 60.0);
    return testing::Square(spec, blobs, context);
  };
  RunningWorker worker(client, stages, "w");
  const Digest job = Submit(*coordinator, "7");
  ASSERT_TRUE(WaitUntil([&] { return attempts == 1; }, 20.0));
  server.reset();  // as if the process had died: nobody is told
  coordinator.reset();
  coordinator = OpenCoordinator(folder_ / "state", clock_);
  server = *GrpcServer::Start(*coordinator, address);
  const auto is_squaring = [&] { return coordinator->GetJob(job)->stages[1].tasks_running == 1; };
  ASSERT_TRUE(WaitUntil(is_squaring, 20.0));
  may_end = true;
  EXPECT_EQ(WaitForEnd(*coordinator, job)->state, JobState::kDone);
  EXPECT_EQ(*ToyAnswer(*coordinator, job), "49");
  EXPECT_EQ(attempts.load(), 1);
  worker.RequestStop();
  stop.request_stop();
  EXPECT_TRUE(worker.Join().ok());
  coordinator->BeginShutdown();
}

}  // namespace
}  // namespace orbweave
