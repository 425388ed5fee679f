// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/coordinator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <limits>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/pipeline/build_version.h"
#include "tests/support/command.h"
#include "tests/support/manual_clock.h"
#include "tests/support/toy_job.h"
#include "tests/support/wait_for_end.h"

namespace orbweave {
namespace {

using testing::FindToyPlan;
using ::testing::HasSubstr;
using testing::PrepareToyJob;
using testing::TemporaryFolder;
using testing::ToyAnswer;
using testing::ToyStages;
using testing::WaitForEnd;
using testing::WaitUntil;

constexpr double kWait_s = 5.0;

/// A coordinator on a clock turned by hand, and toy workers that are driven call by call.
class CoordinatorTest : public ::testing::Test {
 protected:
  void SetUp() override { Restart(); }

  void Restart() {
    coordinator_.reset();
    auto opened = Coordinator::Open(Options(), clock_);
    ASSERT_TRUE(opened.ok()) << opened.status();
    coordinator_ = *std::move(opened);
  }

  CoordinatorOptions Options() {
    return {.state_dir = folder_ / "state",
            .lease_s = 20.0,
            .retry = {.first_wait_s = 1.0},
            .find_plan = FindToyPlan,
            .log = [this](const LogEvent& event) {
              const std::lock_guard lock(events_mutex_);
              events_.push_back(event.event);
            }};
  }

  size_t CountEvents(const std::string& event) {
    const std::lock_guard lock(events_mutex_);
    return static_cast<size_t>(std::ranges::count(events_, event));
  }

  uint64_t Join(const std::string& name, const std::vector<LeaseProgress>& held = {}) {
    return coordinator_->Join({.name = name, .version = std::string(BuildVersion()), .held = held})
        ->session;
  }

  Digest Submit(const std::string& numbers) {
    const auto job = PrepareToyJob(*coordinator_, numbers);
    return *coordinator_->SubmitJob(*job);
  }

  Lease MustLease(uint64_t session) {
    auto lease = coordinator_->LeaseTask(session, 0, kWait_s);
    ORBWEAVE_CHECK(lease.ok() && lease->has_value());
    return **lease;
  }

  absl::Status Do(uint64_t session, const Lease& lease) {
    const auto result = stages_.at(lease.spec.stage)(lease.spec, *coordinator_, {});
    ORBWEAVE_CHECK(result.ok());
    return coordinator_->CompleteTask(session, lease, *result);
  }

  /// Works until nothing is left; how many tasks that were.
  int DoAll(uint64_t session) {
    int count = 0;
    while (IsAnyJobRunning()) {
      const auto lease = coordinator_->LeaseTask(session, 0, 0.0);
      ORBWEAVE_CHECK(lease.ok());
      if (!lease->has_value()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        continue;
      }
      ORBWEAVE_CHECK(Do(session, **lease).ok());
      ++count;
    }
    return count;
  }

  bool IsAnyJobRunning() {
    const auto jobs = coordinator_->ListJobs();
    return std::any_of(jobs->begin(), jobs->end(), [](const JobStatus& job) {
      return job.state == JobState::kRunning;
    });
  }

  std::string BlobPath(const Digest& digest) const {
    return folder_ / ("state/blobs/" + digest.ToHex().substr(0, 2) + "/" + digest.ToHex());
  }

  TemporaryFolder folder_;
  ManualClock clock_;
  testing::StageMap stages_ = ToyStages();
  std::mutex events_mutex_;
  std::vector<std::string> events_;
  std::unique_ptr<Coordinator> coordinator_;
};

TEST_F(CoordinatorTest, ReassignsTaskWhenLeaseExpiresAndRefusesTheLateResult) {
  const uint64_t slow = Join("slow");
  const uint64_t quick = Join("quick");
  Submit("1");
  const Lease first = MustLease(slow);
  clock_.Advance(19.0);
  EXPECT_FALSE(coordinator_->LeaseTask(quick, 0, 0.0)->has_value());
  clock_.Advance(2.0);
  (void)coordinator_->ListJobs();  // the lease is found to have ended
  clock_.Advance(2.0);             // the wait before the second attempt
  const Lease second = MustLease(quick);
  EXPECT_EQ(second.task, first.task);
  EXPECT_GT(second.epoch, first.epoch);
  EXPECT_TRUE(absl::IsFailedPrecondition(Do(slow, first)));
  EXPECT_EQ(CountEvents("result_refused"), 1U);
  EXPECT_TRUE(Do(quick, second).ok());
  EXPECT_EQ(CountEvents("result_refused"), 1U);
}

TEST_F(CoordinatorTest, HeartbeatsKeepALeaseAndTellWhichAreLost) {
  const uint64_t session = Join("w");
  Submit("1");
  const Lease lease = MustLease(session);
  for (int i = 0; i < 5; ++i) {
    clock_.Advance(15.0);
    const auto reply = coordinator_->Heartbeat(session, {{lease.task, lease.epoch, {}}});
    ASSERT_TRUE(reply.ok());
    EXPECT_TRUE(reply->cancelled.empty());
  }
  clock_.Advance(21.0);
  const auto reply = coordinator_->Heartbeat(session, {{lease.task, lease.epoch, {}}});
  ASSERT_TRUE(reply.ok());
  EXPECT_THAT(reply->cancelled, ::testing::ElementsAre(lease.task));
}

TEST_F(CoordinatorTest, AWorkerThatRejoinsLosesItsOldLeasesAtOnce) {
  const uint64_t old_session = Join("w");
  Submit("1");
  const Lease lease = MustLease(old_session);
  const uint64_t new_session = Join("w");
  EXPECT_TRUE(absl::IsNotFound(coordinator_->Heartbeat(old_session, {}).status()));
  EXPECT_TRUE(absl::IsNotFound(Do(old_session, lease))) << "join again";
  EXPECT_TRUE(absl::IsFailedPrecondition(Do(new_session, lease)));
  clock_.Advance(1.5);
  EXPECT_EQ(MustLease(new_session).task, lease.task);
}

TEST_F(CoordinatorTest, ADeadProcessLosesItsLeasesAtOnce) {
  const uint64_t dead = Join("dead");
  const uint64_t other = Join("other");
  Submit("1");
  const Lease lease = MustLease(dead);
  coordinator_->WorkerDied("dead");
  clock_.Advance(1.5);
  EXPECT_EQ(MustLease(other).task, lease.task);
}

TEST_F(CoordinatorTest, TheFirstResultOfAStragglerWinsAndTheOtherAttemptIsCalledOff) {
  const uint64_t slow = Join("slow");
  const uint64_t quick = Join("quick");
  Submit("1 2 3");
  ASSERT_TRUE(Do(quick, MustLease(quick)).ok());
  const Lease late = MustLease(slow);
  ASSERT_TRUE(Do(quick, MustLease(quick)).ok());
  ASSERT_TRUE(Do(quick, MustLease(quick)).ok());
  EXPECT_FALSE(coordinator_->LeaseTask(quick, 0, 0.0)->has_value());
  for (int beat = 0; beat < 5; ++beat) {
    clock_.Advance(15.0);
    EXPECT_TRUE(coordinator_->Heartbeat(slow, {{late.task, late.epoch, {}}})->cancelled.empty());
  }
  const Lease again = MustLease(quick);
  EXPECT_EQ(again.task, late.task);
  ASSERT_TRUE(Do(quick, again).ok());
  EXPECT_THAT(coordinator_->Heartbeat(slow, {{late.task, late.epoch, {}}})->cancelled,
              ::testing::ElementsAre(late.task));
  EXPECT_TRUE(absl::IsFailedPrecondition(Do(slow, late)));
}

TEST_F(CoordinatorTest, AWorkerThatFailsWhatOthersDoIsSetAside) {
  const uint64_t bad = Join("bad");
  const uint64_t good = Join("good");
  const Digest job = Submit("1 2 3 4");
  ASSERT_TRUE(Do(good, MustLease(good)).ok());
  for (int i = 0; i < 3; ++i) {
    const Lease lease = MustLease(bad);
    ASSERT_TRUE(coordinator_->FailTask(bad, lease, absl::InternalError("bad memory")).ok());
    clock_.Advance(5.0);
    ASSERT_TRUE(Do(good, MustLease(good)).ok());
  }
  EXPECT_FALSE(coordinator_->LeaseTask(bad, 0, 0.0)->has_value());
  const auto status = coordinator_->GetJob(job);
  const auto workers = coordinator_->ListWorkers();
  ASSERT_EQ(workers->size(), 2U);
  EXPECT_TRUE(workers->at(0).set_aside);
  EXPECT_FALSE(workers->at(1).set_aside);
  EXPECT_TRUE(coordinator_->LeaseTask(good, 0, kWait_s)->has_value());
}

TEST_F(CoordinatorTest, StartedAgainItReusesEveryResult) {
  const Digest job = Submit("1 2 3");
  EXPECT_EQ(DoAll(Join("w")), 5);
  ASSERT_EQ(WaitForEnd(*coordinator_, job)->state, JobState::kDone);
  Restart();
  EXPECT_EQ(Submit("1 2 3"), job);
  const auto status = WaitForEnd(*coordinator_, job);
  ASSERT_TRUE(status.ok());
  EXPECT_EQ(status->state, JobState::kDone);
  for (const StageStatus& stage : status->stages)
    EXPECT_EQ(stage.tasks_reused, stage.tasks_total) << stage.stage;
  EXPECT_EQ(*ToyAnswer(*coordinator_, job), "14");
}

TEST_F(CoordinatorTest, StartedAgainInTheMiddleItGoesOnByItself) {
  const Digest job = Submit("1 2 3");
  const uint64_t session = Join("w");
  ASSERT_TRUE(Do(session, MustLease(session)).ok());
  ASSERT_TRUE(Do(session, MustLease(session)).ok());
  const Lease lost = MustLease(session);
  Restart();
  EXPECT_TRUE(absl::IsNotFound(coordinator_->Heartbeat(session, {}).status()));
  EXPECT_TRUE(absl::IsNotFound(coordinator_->CompleteTask(session, lost, {})));
  const uint64_t anew = Join("w");  // the process started anew, too: it lists nothing
  EXPECT_TRUE(absl::IsFailedPrecondition(coordinator_->CompleteTask(anew, lost, {})));
  clock_.Advance(1.5);
  EXPECT_EQ(DoAll(anew), 3);  // two squares and the sum
  EXPECT_EQ(WaitForEnd(*coordinator_, job)->state, JobState::kDone);
  EXPECT_EQ(*ToyAnswer(*coordinator_, job), "14");
}

TEST_F(CoordinatorTest, AnotherJobReusesWhatItShares) {
  Submit("1 2 3");
  DoAll(Join("w"));
  const Digest longer = Submit("1 2 3 4");
  EXPECT_EQ(DoAll(Join("w")), 3);  // its split, one square and its sum
  EXPECT_EQ(*ToyAnswer(*coordinator_, longer), "30");
}

TEST_F(CoordinatorTest, AResultWhoseBlobIsDamagedIsComputedAgain) {
  const Digest job = Submit("1 2 3");
  DoAll(Join("w"));
  const auto outcomes = coordinator_->GetOutcomes(job);
  ASSERT_EQ(outcomes->at(2).stage, "square");
  std::ofstream(BlobPath(outcomes->at(2).result.outputs.at(0))) << "5";
  Restart();
  Submit("1 2 3");
  EXPECT_EQ(DoAll(Join("w")), 1);  // that square; the sum of the same squares is known
  EXPECT_EQ(*ToyAnswer(*coordinator_, job), "14");
}

TEST_F(CoordinatorTest, ABlobThatVanishesInTheMiddleIsMadeAgain) {
  const Digest job = Submit("2 3");
  const uint64_t session = Join("w");
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(Do(session, MustLease(session)).ok());
  const Lease sum = MustLease(session);
  ASSERT_EQ(sum.spec.stage, "sum");
  std::filesystem::remove(BlobPath(DigestOf("4")));
  const auto result = testing::Sum(sum.spec, *coordinator_, {});
  ASSERT_TRUE(absl::IsNotFound(result.status()));
  ASSERT_TRUE(coordinator_->FailTask(session, sum, result.status()).ok());
  EXPECT_EQ(DoAll(session), 2);  // the square of 2 and the sum
  EXPECT_EQ(WaitForEnd(*coordinator_, job)->state, JobState::kDone);
  EXPECT_EQ(*ToyAnswer(*coordinator_, job), "13");
}

TEST_F(CoordinatorTest, AResultThatNamesUnknownBlobsIsRefused) {
  const uint64_t session = Join("w");
  Submit("1");
  const Lease lease = MustLease(session);
  const TaskResult result{.outputs = {DigestOf("never put")}};
  EXPECT_TRUE(absl::IsAborted(coordinator_->CompleteTask(session, lease, result)));
  EXPECT_TRUE(Do(session, lease).ok());
}

TEST_F(CoordinatorTest, AFailedJobKeepsItsReasonAndCanBeSubmittedAgain) {
  const Digest job = Submit("1");
  const uint64_t session = Join("w");
  ASSERT_TRUE(
      coordinator_->FailTask(session, MustLease(session), absl::InvalidArgumentError("no numbers"))
          .ok());
  const auto failed = WaitForEnd(*coordinator_, job);
  EXPECT_EQ(failed->state, JobState::kFailed);
  EXPECT_THAT(failed->error, HasSubstr("stage split, part 0"));
  EXPECT_THAT(failed->error, HasSubstr("no numbers"));
  ASSERT_TRUE(coordinator_->CancelJob(job).ok());  // does not hide the reason
  Restart();
  EXPECT_EQ(coordinator_->GetJob(job)->state, JobState::kFailed);
  EXPECT_EQ(coordinator_->GetJob(job)->error, failed->error);
  Submit("1");
  DoAll(Join("w"));
  EXPECT_EQ(coordinator_->GetJob(job)->state, JobState::kDone);
}

TEST_F(CoordinatorTest, ACancelledJobStaysCancelled) {
  const Digest job = Submit("1");
  const uint64_t session = Join("w");
  const Lease lease = MustLease(session);
  ASSERT_TRUE(coordinator_->CancelJob(job).ok());
  EXPECT_THAT(coordinator_->Heartbeat(session, {{lease.task, lease.epoch, {}}})->cancelled,
              ::testing::ElementsAre(lease.task));
  EXPECT_TRUE(absl::IsFailedPrecondition(Do(session, lease)));
  Restart();
  EXPECT_EQ(coordinator_->GetJob(job)->state, JobState::kCancelled);
}

TEST_F(CoordinatorTest, ServesTheOldestJobFirst) {
  const Digest older = Submit("1");
  Submit("2");
  const uint64_t session = Join("w");
  ASSERT_TRUE(
      WaitUntil([&] { return coordinator_->GetJob(older)->stages[0].tasks_total == 1; }, 20.0));
  const Lease lease = MustLease(session);
  EXPECT_THAT(lease.spec.inputs, ::testing::ElementsAre(DigestOf("1")));
}

TEST_F(CoordinatorTest, ASlotHoldsAQuickTaskAheadAndNoMore) {
  const WorkerInfo worker{.name = "w", .version = std::string(BuildVersion()), .slots = 2};
  const uint64_t session = coordinator_->Join(worker)->session;
  Submit("1 2 3 4 5");
  const Lease split = MustLease(session);
  EXPECT_FALSE(coordinator_->LeaseTask(session, 0, 0.0)->has_value());
  ASSERT_TRUE(Do(session, split).ok());
  ASSERT_TRUE(Do(session, MustLease(session)).ok());
  const Lease first = MustLease(session);
  const Lease ahead = MustLease(session);
  EXPECT_NE(first.task, ahead.task);
  EXPECT_FALSE(coordinator_->LeaseTask(session, 0, 0.0)->has_value());
  EXPECT_TRUE(coordinator_->LeaseTask(session, 1, kWait_s)->has_value()) << "another slot may";
  ASSERT_TRUE(Do(session, ahead).ok()) << "in whatever order they end";
  EXPECT_TRUE(Do(session, MustLease(session)).ok());
  EXPECT_TRUE(Do(session, first).ok());
}

TEST_F(CoordinatorTest, RefusesASecondCoordinatorOnTheSameState) {
  const auto second = Coordinator::Open(Options(), clock_);
  EXPECT_TRUE(absl::IsFailedPrecondition(second.status()));
  EXPECT_THAT(std::string(second.status().message()), HasSubstr("in use by another coordinator"));
}

TEST_F(CoordinatorTest, RefusesAFolderWhoseResultsAreFiles) {
  testing::WriteAll(folder_ / "old/generation", "3");
  CoordinatorOptions options = Options();
  options.state_dir = folder_ / "old";
  const auto opened = Coordinator::Open(options, clock_);
  EXPECT_TRUE(absl::IsFailedPrecondition(opened.status()));
  EXPECT_THAT(std::string(opened.status().message()), HasSubstr("older version"));
  EXPECT_THAT(std::string(opened.status().message()), HasSubstr(options.state_dir));
}

TEST_F(CoordinatorTest, ShutdownWakesWaitingCallsAndTellsWorkersToLeave) {
  const uint64_t session = Join("w");
  std::jthread end([this] { coordinator_->BeginShutdown(); });
  EXPECT_TRUE(absl::IsUnavailable(coordinator_->LeaseTask(session, 0, 60.0).status()));
  EXPECT_TRUE(coordinator_->Heartbeat(session, {})->shutdown);
}

TEST_F(CoordinatorTest, WhoWillComeBackGivesNoTasksAndSendsNobodyHome) {
  const uint64_t session = Join("w");
  std::jthread end([this] { coordinator_->BeginShutdown(Farewell::kComeBack); });
  EXPECT_TRUE(absl::IsUnavailable(coordinator_->LeaseTask(session, 0, 60.0).status()));
  EXPECT_FALSE(coordinator_->Heartbeat(session, {})->shutdown);
}

TEST_F(CoordinatorTest, ACallThatWaitsDoesNotKeepASilentWorkerAlive) {
  const uint64_t silent = Join("silent");
  auto waiting = std::async(std::launch::async,
                            [&] { return coordinator_->LeaseTask(silent, 0, 60.0).status(); });
  // Twice, as the call may have come after the first; it still waits then.
  for (int i = 0; i < 2; ++i) {
    clock_.Advance(20.5);
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
  }
  EXPECT_FALSE(coordinator_->ListWorkers()->at(0).alive);
  EXPECT_NE(waiting.wait_for(std::chrono::seconds(0)), std::future_status::ready);
  coordinator_->BeginShutdown();
  waiting.wait();
}

TEST_F(CoordinatorTest, AWaitEndsByTheCoordinatorsClockAndAfterAMinuteAtLast) {
  const uint64_t session = Join("w");
  for (const double wait_s : {30.0, 1e9}) {
    auto waiting =
        std::async(std::launch::async, [&] { return coordinator_->LeaseTask(session, 0, wait_s); });
    EXPECT_TRUE(WaitUntil(
        [&] {
          clock_.Advance(wait_s == 30.0 ? 31.0 : 61.0);
          return waiting.wait_for(std::chrono::milliseconds(300)) == std::future_status::ready;
        },
        10.0))
        << wait_s;
    if (waiting.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
      coordinator_->BeginShutdown();
    const auto lease = waiting.get();
    EXPECT_TRUE(lease.ok() && !lease->has_value()) << lease.status();
  }
}

TEST_F(CoordinatorTest, AWaitIsANumberOfSeconds) {
  const uint64_t session = Join("w");
  using Limits = std::numeric_limits<double>;
  for (const double wait_s : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), -1.0}) {
    const auto lease = coordinator_->LeaseTask(session, 0, wait_s);
    EXPECT_TRUE(absl::IsInvalidArgument(lease.status())) << wait_s;
  }
}

TEST_F(CoordinatorTest, WhoHasLeftIsGivenNothing) {
  const uint64_t session = Join("w");
  std::stop_source left;
  auto waiting = std::async(std::launch::async, [&] {
    return coordinator_->LeaseTask(session, 0, 60.0, left.get_token()).status();
  });
  left.request_stop();
  EXPECT_TRUE(absl::IsCancelled(waiting.get()));
  Submit("1");
  EXPECT_EQ(MustLease(session).epoch & 0xffffffffU, 1U) << "the first lease of all";
}

TEST_F(CoordinatorTest, ManySlotsThatWaitShareWhatBecomesReady) {
  constexpr int kWorkers = 20;
  std::vector<std::future<std::optional<Lease>>> waiting;
  std::vector<uint64_t> sessions;
  for (int i = 0; i < kWorkers; ++i) sessions.push_back(Join("w" + std::to_string(i)));
  const uint64_t first = Join("first");
  const Digest job = Submit("1 2 3 4 5 6 7 8 9 10");
  const Lease split = MustLease(first);
  for (const uint64_t session : sessions) {
    waiting.push_back(std::async(
        std::launch::async, [&, session] { return *coordinator_->LeaseTask(session, 0, 15.0); }));
  }
  ASSERT_TRUE(Do(first, split).ok());
  ASSERT_TRUE(
      WaitUntil([&] { return coordinator_->GetJob(job)->stages[1].tasks_running == 10; }, 20.0));
  clock_.Advance(16.0);
  std::vector<Digest> tasks;
  for (auto& each : waiting) {
    if (const std::optional<Lease> lease = each.get()) tasks.push_back(lease->task);
  }
  std::ranges::sort(tasks);
  EXPECT_EQ(tasks.size(), 10U) << "the others got none";
  tasks.erase(std::ranges::unique(tasks).begin(), tasks.end());
  EXPECT_EQ(tasks.size(), 10U) << "each was given to one";
}

}  // namespace
}  // namespace orbweave
