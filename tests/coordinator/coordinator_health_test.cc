// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What a coordinator tells whoever runs it: whether it moves, can work, and has work for others.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <thread>

#include "coordinator/coordinator.h"
#include "core/pipeline/build_version.h"
#include "tests/support/command.h"
#include "tests/support/failing_journal.h"
#include "tests/support/manual_clock.h"
#include "tests/support/memory_objects.h"
#include "tests/support/toy_job.h"
#include "tests/support/wait_for_end.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

using testing::FailingJournal;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::WaitForEnd;
using testing::WaitUntil;

size_t CountFiles(const std::string& folder) {
  size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files += entry.is_regular_file();
  return files;
}

class CoordinatorHealth : public ::testing::Test {
 protected:
  void SetUp() override { Restart(); }
  void TearDown() override {
    is_stuck_ = false;
    fails_.may_answer = true;
  }

  void Restart(uint32_t max_slots = 1000) {
    coordinator_.reset();
    CoordinatorOptions options{.state_dir = folder_.Path(), .find_plan = testing::FindToyPlan};
    options.max_slots = max_slots;
    options.log = [this](const LogEvent&) { WaitUntil([this] { return !is_stuck_; }, 60.0); };
    options.open_journal = testing::OpenFailingJournal(fails_);
    auto opened = Coordinator::Open(options, clock_);
    ASSERT_TRUE(opened.ok()) << opened.status();
    coordinator_ = *std::move(opened);
  }

  Digest Submit(const std::string& numbers) {
    return *coordinator_->SubmitJob(*testing::PrepareToyJob(*coordinator_, numbers));
  }
  uint64_t Join() {
    return coordinator_->Join({.name = "w", .version = std::string(BuildVersion())})->session;
  }
  Lease MustLease(uint64_t session) {
    const auto lease = coordinator_->LeaseTask(session, 0, 20.0);
    ORBWEAVE_CHECK(lease.ok() && lease->has_value());
    return **lease;
  }
  absl::Status Do(uint64_t session, const Lease& lease) {
    const auto result = stages_.at(lease.spec.stage)(lease.spec, *coordinator_, {});
    ORBWEAVE_CHECK(result.ok());
    return coordinator_->CompleteTask(session, lease, *result);
  }
  bool IsLive() { return coordinator_->CheckLive().ok(); }

  FailingJournal::Switch fails_;
  std::atomic<bool> is_stuck_{false};  ///< whoever logs, which is done with the lock, stands still
  TemporaryFolder folder_;
  ManualClock clock_;
  testing::StageMap stages_ = testing::ToyStages();
  std::unique_ptr<Coordinator> coordinator_;
};

TEST_F(CoordinatorHealth, LivesAlsoWithNothingToDo) {
  EXPECT_TRUE(IsLive());
  for (int i = 0; i < 3; ++i) {
    clock_.Advance(1000.0);
    EXPECT_TRUE(WaitUntil([this] { return IsLive(); }, 20.0));
  }
}

TEST_F(CoordinatorHealth, LivesNoMoreWhenItsThreadsStandStillForALease) {
  // Also from the start: neither thread may have moved when this caller takes the lock.
  is_stuck_ = true;
  std::jthread caller([this] { Join(); });
  EXPECT_TRUE(WaitUntil(
      [this] {
        clock_.Advance(21.0);
        return !IsLive();
      },
      20.0));
  EXPECT_THAT(std::string(coordinator_->CheckLive().message()),
              HasSubstr("has not moved for 20 s"));
  is_stuck_ = false;
  EXPECT_TRUE(WaitUntil([this] { return IsLive(); }, 20.0));
}

TEST_F(CoordinatorHealth, LivesAndIsNotReadyWhileTheObjectStoreTakesNothing) {
  const auto store = std::make_shared<testing::MemoryObjects>();
  const TemporaryFolder folder;
  const auto coordinator = Coordinator::Open(
      {.state_dir = folder.Path(), .find_plan = testing::FindToyPlan, .objects = store}, clock_);
  ASSERT_TRUE(coordinator.ok()) << coordinator.status();
  EXPECT_TRUE((*coordinator)->CheckReady().ok());
  store->is_read_only = true;
  const absl::Status not_ready = (*coordinator)->CheckReady();
  EXPECT_THAT(std::string(not_ready.message()), HasSubstr("object store"));
  const int asked = store->calls;
  EXPECT_TRUE((*coordinator)->CheckLive().ok());
  EXPECT_EQ(store->calls, asked) << "the store is not asked";
}

TEST_F(CoordinatorHealth, LivesWhileTheJournalIsAway) {
  const auto job = testing::PrepareToyJob(*coordinator_, "1");
  fails_.lookups_hang = true;
  ASSERT_TRUE(coordinator_->SubmitJob(*job).ok());
  ASSERT_TRUE(WaitUntil([this] { return fails_.is_holding.load(); }, 20.0));
  clock_.Advance(1000.0);
  EXPECT_TRUE(WaitUntil([this] { return IsLive(); }, 20.0)) << coordinator_->CheckLive();
}

TEST_F(CoordinatorHealth, IsReadyAndLeavesNothingBehindWhenAsked) {
  EXPECT_TRUE(coordinator_->CheckReady().ok());
  const size_t files = CountFiles(folder_.Path());
  const BlobTraffic traffic = coordinator_->blob_traffic();
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(coordinator_->CheckReady().ok());
  EXPECT_EQ(CountFiles(folder_.Path()), files);
  EXPECT_EQ(CountFiles(folder_ / "blobs"), 0U);
  EXPECT_EQ(coordinator_->blob_traffic().bytes_in, traffic.bytes_in);
}

TEST_F(CoordinatorHealth, IsNotReadyWhileTheJournalDoesNotSave) {
  fails_.probes_fail = true;
  const absl::Status status = coordinator_->CheckReady();
  EXPECT_TRUE(absl::IsResourceExhausted(status));
  EXPECT_THAT(std::string(status.message()), HasSubstr("journal: disk full"));
  EXPECT_TRUE(IsLive()) << "to start it again would not help";
  fails_.probes_fail = false;
  EXPECT_TRUE(coordinator_->CheckReady().ok());
}

TEST_F(CoordinatorHealth, IsNotReadyWhileNoBlobCanBePut) {
  fs::remove(folder_ / "blobs/tmp");
  const absl::Status status = coordinator_->CheckReady();
  EXPECT_FALSE(status.ok());
  EXPECT_THAT(std::string(status.message()), HasSubstr("blobs: "));
  fs::create_directory(folder_ / "blobs/tmp");
  EXPECT_TRUE(coordinator_->CheckReady().ok());
}

TEST_F(CoordinatorHealth, IsNotReadyWithoutItsJournalOrWhenItEnds) {
  fails_.is_lost = true;
  EXPECT_TRUE(absl::IsFailedPrecondition(coordinator_->CheckReady()));
  fails_.is_lost = false;
  Restart();
  EXPECT_TRUE(coordinator_->CheckReady().ok());
  coordinator_->BeginShutdown(Farewell::kComeBack);
  EXPECT_THAT(std::string(coordinator_->CheckReady().message()), HasSubstr("shutting down"));
}

TEST_F(CoordinatorHealth, WantsASlotForEachTaskThatIsReadyOrRuns) {
  EXPECT_EQ(coordinator_->SlotsWanted(), 0U);
  const Digest job = Submit("1 2 3 4 5");
  EXPECT_EQ(coordinator_->SlotsWanted(), 1U) << "as long as nothing is planned, too";
  const uint64_t session = Join();
  ASSERT_TRUE(Do(session, MustLease(session)).ok());
  EXPECT_TRUE(WaitUntil([this] { return coordinator_->SlotsWanted() == 5; }, 20.0));
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(Do(session, MustLease(session)).ok());
  EXPECT_EQ(MustLease(session).spec.stage, "square");
  EXPECT_EQ(coordinator_->SlotsWanted(), 5U);
  clock_.Advance(59.0);
  EXPECT_EQ(coordinator_->SlotsWanted(), 5U);
  clock_.Advance(2.0);
  EXPECT_EQ(coordinator_->SlotsWanted(), 1U);
  EXPECT_TRUE(coordinator_->CancelJob(job).ok());
  EXPECT_EQ(coordinator_->SlotsWanted(), 1U);
  clock_.Advance(61.0);
  EXPECT_EQ(coordinator_->SlotsWanted(), 0U);
}

TEST_F(CoordinatorHealth, SeesTasksThatCameAndWentUnasked) {
  const Digest job = Submit("1 2 3 4 5");
  const uint64_t session = Join();
  for (int i = 0; i < 7; ++i) ASSERT_TRUE(Do(session, MustLease(session)).ok());
  ASSERT_EQ(WaitForEnd(*coordinator_, job)->state, JobState::kDone);
  EXPECT_EQ(coordinator_->SlotsWanted(), 5U);
  clock_.Advance(61.0);
  EXPECT_EQ(coordinator_->SlotsWanted(), 0U);
  Restart();
  EXPECT_EQ(coordinator_->SlotsWanted(), 0U) << "a job that has ended is only looked through";
}

TEST_F(CoordinatorHealth, WantsNoMoreSlotsThanItMay) {
  Restart(3);
  Submit("1 2 3 4 5");
  const uint64_t session = Join();
  ASSERT_TRUE(Do(session, MustLease(session)).ok());
  const Lease lease = MustLease(session);
  EXPECT_EQ(lease.spec.stage, "square");
  EXPECT_EQ(coordinator_->SlotsWanted(), 3U);
}

}  // namespace
}  // namespace orbweave
