// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Tasks that ask for more than a thread, and workers that offer it or do not.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coordinator/coordinator.h"
#include "core/pipeline/build_version.h"
#include "tests/support/command.h"
#include "tests/support/manual_clock.h"
#include "tests/support/toy_job.h"

namespace orbweave {
namespace {

using testing::PrepareToyJob;
using testing::TemporaryFolder;
using testing::ToyStages;
using testing::WaitUntil;

constexpr uint64_t kGiB = uint64_t{1} << 30;

/// The toy plan; of kind "toy" its second stage asks for `needs`.
class StageNeedsTest : public ::testing::Test {
 protected:
  void Open(const StageNeeds& needs) {
    const auto find_plan = [needs](std::string_view) -> absl::StatusOr<JobPlan> {
      JobPlan plan = testing::ToyPlan();
      plan.stages[1].needs = needs;
      return plan;
    };
    auto opened = Coordinator::Open(
        {.state_dir = folder_ / "state", .retry = {.first_wait_s = 1.0}, .find_plan = find_plan},
        clock_);
    ORBWEAVE_CHECK(opened.ok());
    coordinator_ = *std::move(opened);
  }

  uint64_t Join(const std::string& name,
                uint32_t slots,
                const WorkerOffers& offers,
                std::optional<double> stays_s = std::nullopt) {
    return coordinator_
        ->Join({.name = name,
                .version = std::string(BuildVersion()),
                .slots = slots,
                .offers = offers,
                .stays_s = stays_s})
        ->session;
  }

  /// A job whose second stage is ready: the first was done by a worker that offers nothing.
  Digest SubmitAndSplit(const std::string& numbers) {
    const uint64_t session = Join("splitter", 1, {});
    const Digest job = *coordinator_->SubmitJob(*PrepareToyJob(*coordinator_, numbers));
    const auto lease = coordinator_->LeaseTask(session, 0, 5.0);
    ORBWEAVE_CHECK(lease.ok() && lease->has_value() && (*lease)->spec.stage == "split");
    ORBWEAVE_CHECK(Do(session, **lease).ok());
    ORBWEAVE_CHECK(
        WaitUntil([&] { return coordinator_->GetJob(job)->stages[1].tasks_total > 0; }, 20.0));
    (void)coordinator_->Leave(session);
    return job;
  }

  std::optional<Lease> Ask(uint64_t session, uint32_t slot) {
    return *coordinator_->LeaseTask(session, slot, 0.0);
  }

  absl::Status Do(uint64_t session, const Lease& lease) {
    const auto result = stages_.at(lease.spec.stage)(lease.spec, *coordinator_, {});
    ORBWEAVE_CHECK(result.ok());
    return coordinator_->CompleteTask(session, lease, *result);
  }

  TemporaryFolder folder_;
  ManualClock clock_;
  testing::StageMap stages_ = ToyStages();
  std::unique_ptr<Coordinator> coordinator_;
};

TEST_F(StageNeedsTest, GoToWorkersThatMeetThem) {
  Open({.memory_bytes = 8 * kGiB, .gpus = 1});
  SubmitAndSplit("1 2 3");
  const uint64_t small = Join("small", 2, {.memory_bytes = 4 * kGiB, .gpus = 1});
  const uint64_t plain = Join("plain", 2, {.memory_bytes = 64 * kGiB});
  const uint64_t large = Join("large", 2, {.memory_bytes = 64 * kGiB, .gpus = 2});
  EXPECT_FALSE(Ask(small, 0));
  EXPECT_FALSE(Ask(plain, 0));
  EXPECT_TRUE(Ask(large, 0));
  EXPECT_TRUE(Ask(large, 1));
}

TEST_F(StageNeedsTest, TasksOfAWorkerShareWhatItOffers) {
  Open({.memory_bytes = 30 * kGiB, .threads = 2});
  SubmitAndSplit("1 2 3 4 5");
  const uint64_t session = Join("w", 5, {.memory_bytes = 64 * kGiB, .threads = 16});
  const std::optional<Lease> first = Ask(session, 0);
  EXPECT_TRUE(first);
  EXPECT_TRUE(Ask(session, 1));
  EXPECT_FALSE(Ask(session, 2)) << "90 GiB";
  ASSERT_TRUE(Do(session, *first).ok());
  EXPECT_TRUE(Ask(session, 3)) << "there is room again";
}

TEST_F(StageNeedsTest, AWorkerThatStatesNothingHasAThreadForEachSlot) {
  Open({.memory_bytes = 1000 * kGiB, .threads = 3});
  SubmitAndSplit("1 2 3");
  EXPECT_FALSE(Ask(Join("two", 2, {}), 0));
  const uint64_t three = Join("three", 3, {});
  EXPECT_TRUE(Ask(three, 0));
  EXPECT_FALSE(Ask(three, 1)) << "all its threads are taken";
}

TEST_F(StageNeedsTest, WhatNoWorkerEverHasIsNamedInTheStatus) {
  Open({.gpus = 1});
  const Digest job = SubmitAndSplit("1");
  EXPECT_EQ(coordinator_->GetJob(job)->unmet, "") << "there is no worker at all";
  Join("a", 2, {});
  EXPECT_EQ(coordinator_->GetJob(job)->unmet,
            "a task of stage square asks for 1 GPU (no worker has any)");
  EXPECT_EQ(coordinator_->ListJobs()->front().unmet, coordinator_->GetJob(job)->unmet);
  const uint64_t session = Join("b", 1, {.gpus = 1});
  EXPECT_EQ(coordinator_->GetJob(job)->unmet, "");
  const std::optional<Lease> lease = Ask(session, 0);
  ASSERT_TRUE(lease);
  ASSERT_TRUE(coordinator_->DrainWorkers("b").ok());
  EXPECT_EQ(coordinator_->GetJob(job)->unmet, "") << "nothing waits";
  ASSERT_TRUE(coordinator_->FailTask(session, *lease, absl::CancelledError("leaves")).ok());
  EXPECT_NE(coordinator_->GetJob(job)->unmet, "") << "it is given no more";
}

TEST_F(StageNeedsTest, WhoLeavesSoonGetsNothingThatUsuallyTakesLonger) {
  Open({});
  const Digest job = SubmitAndSplit("1 2 3 4 5");
  const uint64_t staying = Join("staying", 1, {});
  const std::optional<Lease> first = Ask(staying, 0);
  ASSERT_TRUE(first);
  clock_.Advance(15.0);
  ASSERT_TRUE(Do(staying, *first).ok());
  const uint64_t leaving = Join("leaving", 1, {}, 14.0);
  EXPECT_FALSE(Ask(leaving, 0)) << "the one that is done took 15 s";
  EXPECT_EQ(coordinator_->GetJob(job)->unmet, "");
  const uint64_t patient = Join("patient", 1, {}, 16.0);
  EXPECT_TRUE(Ask(patient, 0));
  clock_.Advance(2.0);
  const uint64_t later = Join("patient", 1, {}, 14.0);
  EXPECT_FALSE(Ask(later, 0)) << "by now it leaves too soon";
  (void)coordinator_->Leave(staying);
  EXPECT_EQ(coordinator_->GetJob(job)->unmet,
            "a task of stage square takes 15 s, longer than any worker stays");
}

TEST_F(StageNeedsTest, WhoFailedATaskTriesAgainWhereNobodyElseMeetsItsNeeds) {
  Open({.gpus = 1});
  SubmitAndSplit("1");
  Join("plain", 1, {});
  const uint64_t session = Join("gpu", 1, {.gpus = 1});
  const std::optional<Lease> lease = Ask(session, 0);
  ASSERT_TRUE(lease);
  ASSERT_TRUE(coordinator_->FailTask(session, *lease, absl::InternalError("once")).ok());
  clock_.Advance(5.0);
  EXPECT_TRUE(Ask(session, 0));
}

TEST_F(StageNeedsTest, ALaterJobsSmallTasksLeaveRoomForAnOlderJobsLargeOne) {
  Open({.threads = 2});
  const auto submit = [&](const std::string& numbers) {
    return *coordinator_->SubmitJob(*PrepareToyJob(*coordinator_, numbers));
  };
  submit("1 2");
  const uint64_t session = Join("w", 2, {});
  const auto split = coordinator_->LeaseTask(session, 0, 5.0);
  ASSERT_TRUE(split.ok() && split->has_value());
  const Digest later = submit("3 4");
  const auto small = coordinator_->LeaseTask(session, 1, 5.0);
  ASSERT_TRUE(small.ok() && small->has_value());
  EXPECT_EQ((*small)->spec.stage, "split") << "of the later job";
  const Digest latest = submit("5 6");
  ASSERT_TRUE(Do(session, **split).ok());
  ASSERT_TRUE(WaitUntil(
      [&] {
        return coordinator_->ListJobs()->front().stages[1].tasks_total > 0 &&
               coordinator_->GetJob(latest)->stages[0].tasks_total > 0;
      },
      20.0));
  EXPECT_FALSE(Ask(session, 0)) << "the latest job would take the room";
  ASSERT_TRUE(coordinator_->FailTask(session, **small, absl::CancelledError("back")).ok());
  const std::optional<Lease> large = Ask(session, 0);
  ASSERT_TRUE(large);
  EXPECT_EQ(large->spec.stage, "square");
  EXPECT_EQ(coordinator_->GetJob(later)->stages[0].tasks_running, 0U);
}

}  // namespace
}  // namespace orbweave
