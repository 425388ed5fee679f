// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Leases across a coordinator that is started again, and across a journal that fails.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <thread>

#include "coordinator/coordinator.h"
#include "core/pipeline/build_version.h"
#include "tests/support/command.h"
#include "tests/support/failing_journal.h"
#include "tests/support/manual_clock.h"
#include "tests/support/toy_job.h"
#include "tests/support/wait_for_end.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using testing::FailingJournal;
using testing::FindToyPlan;
using ::testing::HasSubstr;
using testing::PrepareToyJob;
using testing::TemporaryFolder;
using testing::ToyAnswer;
using testing::ToyStages;
using testing::WaitForEnd;
using testing::WaitUntil;

/// A coordinator on a clock turned by hand, and toy workers that are driven call by call.
class RestartTest : public ::testing::Test {
 protected:
  void SetUp() override { Restart(); }

  void Restart(bool leases_survive = true) {
    coordinator_.reset();
    CoordinatorOptions options{
        .state_dir = folder_.Path(), .leases_survive = leases_survive, .find_plan = find_plan_};
    options.lost = [this] { was_told_ = true; };
    options.open_journal = testing::OpenFailingJournal(fails_);
    options.log = [this](const LogEvent& event) {
      const std::lock_guard lock(events_mutex_);
      if (event.event.starts_with("job_")) job_events_.push_back(event);
    };
    auto opened = Coordinator::Open(options, clock_);
    ASSERT_TRUE(opened.ok()) << opened.status();
    coordinator_ = *std::move(opened);
  }

  uint64_t Join(const std::string& name,
                const std::vector<LeaseProgress>& held = {},
                uint64_t process = 0) {
    return coordinator_
        ->Join({.name = name,
                .version = std::string(BuildVersion()),
                .slots = 2,
                .held = held,
                .process = process})
        ->session;
  }
  static LeaseProgress Held(const Lease& lease) { return {lease.task, lease.epoch, {}}; }

  Digest Submit(const std::string& numbers) {
    return *coordinator_->SubmitJob(*PrepareToyJob(*coordinator_, numbers));
  }

  Lease MustLease(uint64_t session, uint32_t slot = 0) {
    auto lease = coordinator_->LeaseTask(session, slot, 5.0);
    ORBWEAVE_CHECK(lease.ok() && lease->has_value());
    return **lease;
  }

  bool GetsNothing(uint64_t session) {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const auto lease = coordinator_->LeaseTask(session, 0, 0.0);
    return lease.ok() && !lease->has_value();
  }

  absl::Status Do(uint64_t session, const Lease& lease) {
    const auto result = stages_.at(lease.spec.stage)(lease.spec, *coordinator_, {});
    ORBWEAVE_CHECK(result.ok());
    return coordinator_->CompleteTask(session, lease, *result);
  }

  bool IsStagePlanned(const Digest& job, size_t stage) {
    return WaitUntil([&] { return coordinator_->GetJob(job)->stages[stage].tasks_total > 0; },
                     20.0);
  }

  FailingJournal::Switch fails_;
  TemporaryFolder folder_;
  PlanLookup find_plan_ = FindToyPlan;
  ManualClock clock_;
  testing::StageMap stages_ = ToyStages();
  std::atomic<bool> was_told_{false};
  std::mutex events_mutex_;
  std::vector<LogEvent> job_events_;
  std::unique_ptr<Coordinator> coordinator_;
};

TEST_F(RestartTest, SaysOfAJobThatGoesOnWhatItSaidWhenItBegan) {
  auto job = PrepareToyJob(*coordinator_, "1 2");
  ASSERT_TRUE(job.ok());
  job->traceparent = "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01";
  ASSERT_TRUE(coordinator_->SubmitJob(*job).ok());
  Restart();
  ASSERT_TRUE(coordinator_->CancelJob(job->Id()).ok());
  Restart();
  const std::lock_guard lock(events_mutex_);
  ASSERT_EQ(job_events_.size(), 3U) << "with one that has ended nobody goes on";
  const LogEvent& submitted = job_events_[0];
  const LogEvent& resumed = job_events_[1];
  EXPECT_EQ(submitted.event, "job_submitted");
  EXPECT_EQ(resumed.event, "job_resumed");
  EXPECT_EQ(resumed.job, job->Id());
  EXPECT_EQ(resumed.since_epoch, submitted.since_epoch);
  EXPECT_EQ(resumed.traceparent, job->traceparent);
  EXPECT_EQ(job_events_[2].event, "job_cancelled");
}

TEST_F(RestartTest, WhoLostTheJournalGivesAndTakesNothingMore) {
  Submit("3");
  const uint64_t session = Join("w");
  const Lease lease = MustLease(session);
  EXPECT_TRUE(coordinator_->health().ok());
  fails_.is_lost = true;
  EXPECT_TRUE(absl::IsUnavailable(Do(session, lease))) << "the other coordinator will take it";
  ASSERT_TRUE(WaitUntil([this] { return was_told_.load(); }, 20.0));
  EXPECT_TRUE(absl::IsAborted(coordinator_->health()));
  EXPECT_TRUE(absl::IsUnavailable(coordinator_->LeaseTask(session, 0, 10.0).status()));
  EXPECT_TRUE(absl::IsUnavailable(coordinator_->Heartbeat(session, {Held(lease)}).status()));
  fails_.is_lost = false;
  Restart();
  EXPECT_TRUE(Do(Join("w", {Held(lease)}), lease).ok()) << "as the other would";
}

absl::StatusOr<JobPlan> FindPlanOfANewerBuild(std::string_view kind) {
  ORBWEAVE_ASSIGN_OR_RETURN(JobPlan plan, FindToyPlan(kind));
  for (StageRule& rule : plan.stages) rule.version += "+";
  return plan;
}

TEST_F(RestartTest, AFinishedJobIsNotComputedAgainByANewerBuildUntilSomebodyAsks) {
  const Digest job = Submit("3");
  uint64_t session = Join("w");
  while (coordinator_->GetJob(job)->state == JobState::kRunning) {
    const auto lease = coordinator_->LeaseTask(session, 0, 0.0);
    ASSERT_TRUE(lease.ok());
    if (!lease->has_value()) continue;
    ASSERT_TRUE(Do(session, **lease).ok());
  }
  ASSERT_EQ(coordinator_->GetJob(job)->state, JobState::kDone);
  find_plan_ = FindPlanOfANewerBuild;
  Restart();
  session = Join("w");
  ASSERT_TRUE(
      WaitUntil([&] { return coordinator_->GetJob(job)->state == JobState::kFailed; }, 20.0));
  EXPECT_NE(coordinator_->GetJob(job)->error.find("submit it again"), std::string::npos);
  EXPECT_TRUE(GetsNothing(session));
  EXPECT_EQ(Submit("3"), job);
  EXPECT_TRUE(Do(session, MustLease(session)).ok());
  find_plan_ = FindToyPlan;
}

TEST_F(RestartTest, WhoGetsNothingDoesNotWaitForTheDisk) {
  Submit("3");
  const uint64_t session = Join("w");
  const uint64_t other = Join("other");
  fails_.starts_are_slow = true;
  auto lease =
      std::async(std::launch::async, [&] { return coordinator_->LeaseTask(session, 0, 5.0); });
  ASSERT_TRUE(WaitUntil([&] { return fails_.is_starting.load(); }, 20.0));
  const auto nothing = coordinator_->LeaseTask(other, 0, 0.0);
  EXPECT_TRUE(nothing.ok() && !nothing->has_value());
  EXPECT_EQ(lease.wait_for(std::chrono::seconds(0)), std::future_status::timeout);
  fails_.starts_are_slow = false;
  EXPECT_TRUE(lease.get()->has_value());
}

TEST_F(RestartTest, AHolderThatComesBackGoesOnAndHandsItsResultIn) {
  const Digest job = Submit("3 4");
  uint64_t session = Join("w");
  ASSERT_TRUE(Do(session, MustLease(session)).ok());
  const Lease lease = MustLease(session);
  Restart();
  session = Join("w", {Held(lease)});
  ASSERT_TRUE(IsStagePlanned(job, 1));
  EXPECT_EQ(coordinator_->GetJob(job)->stages[1].tasks_running, 1U);
  EXPECT_EQ(coordinator_->GetJob(job)->stages[0].tasks_reused, 1U);
  const Lease other = MustLease(session, 1);
  EXPECT_NE(other.task, lease.task) << "the task was given out twice";
  EXPECT_GT(other.epoch >> 32, lease.epoch >> 32);
  EXPECT_TRUE(coordinator_->Heartbeat(session, {Held(lease), Held(other)})->cancelled.empty());
  EXPECT_TRUE(Do(session, lease).ok());
  EXPECT_TRUE(Do(session, lease).ok()) << "handed in twice";
  EXPECT_TRUE(Do(session, other).ok());
  EXPECT_TRUE(Do(session, MustLease(session)).ok());
  EXPECT_EQ(WaitForEnd(*coordinator_, job)->state, JobState::kDone);
  EXPECT_EQ(*ToyAnswer(*coordinator_, job), "25");
}

TEST_F(RestartTest, AResultMayComeBeforeItsStageIsPlanned) {
  const Digest job = Submit("3");
  uint64_t session = Join("w");
  ASSERT_TRUE(Do(session, MustLease(session)).ok());
  const Lease lease = MustLease(session);
  fails_.lookups_fail = true;  // nothing can be planned
  Restart();
  session = Join("w", {Held(lease)});
  EXPECT_TRUE(coordinator_->Heartbeat(session, {Held(lease)})->cancelled.empty());
  EXPECT_TRUE(Do(session, lease).ok());
  EXPECT_EQ(coordinator_->GetJob(job)->stages[0].tasks_total, 0U);
  fails_.lookups_fail = false;
  const Lease sum = MustLease(session);
  EXPECT_EQ(sum.spec.stage, "sum") << "the square was computed and is known";
  EXPECT_TRUE(Do(session, sum).ok());
  EXPECT_EQ(WaitForEnd(*coordinator_, job)->state, JobState::kDone);
}

TEST_F(RestartTest, AResultThatComesWhileItsStageIsPlannedIsNotMissed) {
  const Digest job = Submit("3");
  uint64_t session = Join("w");
  ASSERT_TRUE(Do(session, MustLease(session)).ok());
  const Lease lease = MustLease(session);
  fails_.held_lookup = lease.task;
  Restart();
  ASSERT_TRUE(WaitUntil([this] { return fails_.is_holding.load(); }, 20.0));
  session = Join("w", {Held(lease)});
  EXPECT_TRUE(Do(session, lease).ok());
  fails_.may_answer = true;
  EXPECT_EQ(MustLease(session).spec.stage, "sum");
  EXPECT_EQ(coordinator_->GetJob(job)->stages[1].tasks_reused, 1U);
}

TEST_F(RestartTest, OthersGetTheTaskOnlyWhenItsHolderDidNotComeInTime) {
  const Digest job = Submit("3");
  const Lease lease = MustLease(Join("lost"));
  Restart();
  const uint64_t other = Join("other");
  ASSERT_TRUE(IsStagePlanned(job, 0));
  clock_.Advance(19.0);
  EXPECT_TRUE(GetsNothing(other));
  clock_.Advance(2.0);
  const Lease again = MustLease(other);
  EXPECT_EQ(again.task, lease.task);
  EXPECT_EQ(coordinator_->GetJob(job)->stages[0].retries, 0U) << "nobody failed";
  const uint64_t late = Join("lost", {Held(lease)});
  EXPECT_THAT(coordinator_->Heartbeat(late, {Held(lease)})->cancelled, ElementsAre(lease.task));
  EXPECT_TRUE(absl::IsFailedPrecondition(Do(late, lease)));
  EXPECT_TRUE(Do(other, again).ok());
}

TEST_F(RestartTest, AWorkerWhoseProcessStartedAnewFreesItsTasksAtOnce) {
  Submit("3");
  const Lease lease = MustLease(Join("w"));
  Restart();
  const uint64_t session = Join("w");
  clock_.Advance(1.0);
  EXPECT_EQ(MustLease(session).task, lease.task);
}

TEST_F(RestartTest, WorkersThatDiedWithTheCoordinatorAreNotWaitedFor) {
  Submit("3");
  const Lease lease = MustLease(Join("w"));
  Restart(/*leases_survive=*/false);
  EXPECT_EQ(MustLease(Join("other")).task, lease.task);
  coordinator_.reset();
  const auto attempts = (*OpenJournal(folder_.Path()))->LoadAttempts(lease.task);
  ASSERT_EQ(attempts->size(), 2U);
  EXPECT_EQ(attempts->at(0).reason, "the coordinator was started again");
}

TEST_F(RestartTest, SeveralRestartsLoseNoLease) {
  const Digest job = Submit("3");
  const Lease lease = MustLease(Join("w"));
  for (int i = 0; i < 3; ++i) Restart();
  EXPECT_TRUE(Do(Join("w", {Held(lease)}), lease).ok());
  ASSERT_TRUE(IsStagePlanned(job, 1));
  coordinator_.reset();
  const auto attempts = (*OpenJournal(folder_.Path()))->LoadAttempts(lease.task);
  EXPECT_EQ(attempts->size(), 1U) << "computed once";
}

TEST_F(RestartTest, OfTwoLeasesOfOneTaskTheLaterCounts) {
  Submit("3");
  const Lease slow = MustLease(Join("slow"));
  clock_.Advance(21.0);
  (void)coordinator_->ListJobs();
  clock_.Advance(2.0);
  const Lease quick = MustLease(Join("quick"));
  ASSERT_EQ(quick.task, slow.task);
  Restart();
  const uint64_t zombie = Join("slow", {Held(slow)});
  EXPECT_THAT(coordinator_->Heartbeat(zombie, {Held(slow)})->cancelled, ElementsAre(slow.task));
  EXPECT_TRUE(absl::IsFailedPrecondition(Do(zombie, slow)));
  EXPECT_TRUE(Do(Join("quick", {Held(quick)}), quick).ok());
}

TEST_F(RestartTest, ALeaseThatCannotBeWrittenDownIsNotHandedOut) {
  Submit("3");
  const uint64_t session = Join("w");
  fails_.starts_fail = true;
  EXPECT_TRUE(absl::IsResourceExhausted(coordinator_->LeaseTask(session, 0, 5.0).status()));
  fails_.starts_fail = false;
  EXPECT_EQ(MustLease(session).spec.stage, "split");
}

TEST_F(RestartTest, ASlowDiskIsNotTheWorkersFault) {
  const Digest job = Submit("3");
  const uint64_t session = Join("w");
  fails_.starts_are_slow = true;
  auto asked = std::async(std::launch::async, [&] { return MustLease(session); });
  ASSERT_TRUE(WaitUntil([&] { return fails_.is_starting.load(); }, 20.0));
  clock_.Advance(25.0);
  (void)coordinator_->ListJobs();  // leases that ended are found
  fails_.starts_are_slow = false;
  const Lease lease = asked.get();
  EXPECT_THAT(coordinator_->Heartbeat(session, {Held(lease)})->cancelled, ElementsAre());
  EXPECT_TRUE(Do(session, lease).ok());
  EXPECT_EQ(coordinator_->GetJob(job)->stages[0].retries, 0U);
}

TEST_F(RestartTest, AnAttemptThatEndsBeforeItsStartIsWrittenDownDoesNotStayOpen) {
  const Digest job = Submit("3");
  const uint64_t session = Join("w");
  fails_.starts_are_slow = true;
  auto asked =
      std::async(std::launch::async, [&] { return coordinator_->LeaseTask(session, 0, 5.0); });
  ASSERT_TRUE(WaitUntil([&] { return fails_.is_starting.load(); }, 20.0));
  ASSERT_TRUE(coordinator_->CancelJob(job).ok());
  ASSERT_TRUE(IsStagePlanned(Submit("4"), 0));  // by the thread that saves what ended before
  fails_.starts_are_slow = false;
  const auto lease = asked.get();
  ASSERT_TRUE(lease.ok()) << lease.status();
  EXPECT_FALSE(lease->has_value()) << "nobody is to do it";
  coordinator_.reset();
  const auto journal = *OpenJournal(folder_.Path());
  EXPECT_THAT(*journal->LoadOpenAttempts(), ::testing::IsEmpty());
}

TEST_F(RestartTest, AResultThatCannotBeSavedIsHandedInAgain) {
  const Digest job = Submit("3");
  const uint64_t session = Join("w");
  const Lease lease = MustLease(session);
  fails_.results_fail = true;
  EXPECT_TRUE(absl::IsUnavailable(Do(session, lease)));
  EXPECT_EQ(coordinator_->GetJob(job)->stages[0].tasks_running, 1U);
  fails_.results_fail = false;
  EXPECT_TRUE(Do(session, lease).ok());
  EXPECT_EQ(coordinator_->GetJob(job)->stages[0].tasks_done, 1U);
}

TEST_F(RestartTest, ATaskThatKillsItsProcessesGetsNoFreshBudget) {
  const Digest job = Submit("3");
  for (int crash = 0; crash < 3; ++crash) {
    ASSERT_EQ(coordinator_->GetJob(job)->state, JobState::kRunning) << crash;
    const uint64_t session = Join("w" + std::to_string(crash));
    ASSERT_TRUE(IsStagePlanned(job, 0));
    clock_.Advance(60.0);
    (void)coordinator_->Heartbeat(session, {});
    const Lease lease = MustLease(session);
    ASSERT_TRUE(coordinator_->FailTask(session, lease, absl::AbortedError("signal 11")).ok());
    if (crash < 2) Restart();
  }
  const auto status = coordinator_->GetJob(job);
  EXPECT_EQ(status->state, JobState::kFailed);
  EXPECT_THAT(status->error, HasSubstr("lost its process 3 times, last on w2"));
  EXPECT_EQ(Submit("3"), job);
  Restart();
  ASSERT_TRUE(IsStagePlanned(job, 0));
  EXPECT_EQ(coordinator_->GetJob(job)->stages[0].retries, 0U) << "submitted again it begins anew";
}

TEST_F(RestartTest, LeasesThatEndedWithACoordinatorCountForNothing) {
  const Digest job = Submit("3");
  for (int i = 0; i < 6; ++i) {
    (void)MustLease(Join("w"));
    Restart(/*leases_survive=*/false);
  }
  ASSERT_TRUE(IsStagePlanned(job, 0));
  EXPECT_EQ(coordinator_->GetJob(job)->state, JobState::kRunning);
  EXPECT_EQ(coordinator_->GetJob(job)->stages[0].retries, 0U);
}

TEST_F(RestartTest, AWorkerThatIsSetAsideStaysSoUntilItsProcessIsAnother) {
  const Digest job = Submit("1 2 3 4");
  uint64_t bad = Join("bad", {}, 7);
  uint64_t good = Join("good", {}, 8);
  ASSERT_TRUE(Do(good, MustLease(good)).ok());
  for (int i = 0; i < 3; ++i) {
    const Lease lease = MustLease(bad);
    ASSERT_TRUE(coordinator_->FailTask(bad, lease, absl::InternalError("bad memory")).ok());
    clock_.Advance(5.0);
    ASSERT_TRUE(Do(good, MustLease(good)).ok());
  }
  Restart();
  bad = Join("bad", {}, 7);
  good = Join("good", {}, 8);
  ASSERT_TRUE(IsStagePlanned(job, 1));
  EXPECT_TRUE(GetsNothing(bad));
  EXPECT_TRUE(coordinator_->ListWorkers()->at(0).set_aside);
  bad = Join("bad", {}, 9);
  EXPECT_EQ(MustLease(bad).spec.stage, "square");
}

TEST_F(RestartTest, AttemptsAreKeptWithTheirReasons) {
  Submit("3");
  const uint64_t session = Join("w");
  const Lease first = MustLease(session);
  ASSERT_TRUE(
      coordinator_->FailTask(session, first, absl::ResourceExhaustedError("out of memory")).ok());
  clock_.Advance(1.0);
  ASSERT_TRUE(Do(session, MustLease(session)).ok());
  coordinator_.reset();
  const auto attempts = (*OpenJournal(folder_.Path()))->LoadAttempts(first.task);
  ASSERT_TRUE(attempts.ok()) << attempts.status();
  ASSERT_EQ(attempts->size(), 2U);
  EXPECT_EQ(attempts->at(0).reason, "out of memory");
  EXPECT_EQ(attempts->at(0).attempt.worker, "w");
  EXPECT_EQ(attempts->at(0).attempt.stage, "split");
  EXPECT_EQ(attempts->at(1).reason, "");
  EXPECT_TRUE(attempts->at(1).ended_s.has_value());
}

}  // namespace
}  // namespace orbweave
