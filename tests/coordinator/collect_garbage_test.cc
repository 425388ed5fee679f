// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What a collection of garbage leaves and takes, looked at through a whole coordinator.

#include "coordinator/collect_garbage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "coordinator/coordinator.h"
#include "core/pipeline/build_version.h"
#include "tests/support/command.h"
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

/// Toy jobs, and "listed" ones: a part for each recipe in a list that the job brings.
absl::StatusOr<JobPlan> FindPlan(std::string_view kind) {
  if (kind != "listed") return FindToyPlan(kind);
  return JobPlan{"listed",
                 {{.stage = "square",
                   .version = "1",
                   .parts_listed_in = 0,
                   .inputs = {{InputRule::Kind::kRecipe, "", 0}}}}};
}

std::string BytesOf(const Digest& digest) { return {digest.bytes.begin(), digest.bytes.end()}; }

class CollectGarbageTest : public ::testing::Test {
 protected:
  void SetUp() override { Restart(); }

  void Restart() {
    coordinator_.reset();
    auto opened = Coordinator::Open({.state_dir = folder_.Path(), .find_plan = FindPlan}, clock_);
    ASSERT_TRUE(opened.ok()) << opened.status();
    coordinator_ = *std::move(opened);
  }

  Digest Submit(const std::string& numbers) {
    return *coordinator_->SubmitJob(*PrepareToyJob(*coordinator_, numbers));
  }

  bool HasRunningJob() {
    return std::ranges::any_of(*coordinator_->ListJobs(), [](const JobStatus& job) {
      return job.state == JobState::kRunning;
    });
  }

  /// Does up to `tasks` tasks, while a job runs; how many.
  int Work(int tasks) {
    const uint64_t session =
        coordinator_->Join({.name = "w", .version = std::string(BuildVersion())})->session;
    int done = 0;
    while (done < tasks && HasRunningJob()) {
      const auto lease = coordinator_->LeaseTask(session, 0, 0.1);
      ORBWEAVE_CHECK(lease.ok());
      if (!*lease) continue;  // a stage is planned
      const auto result = stages_.at((*lease)->spec.stage)((*lease)->spec, *coordinator_, {});
      ORBWEAVE_CHECK(result.ok());
      ORBWEAVE_CHECK(coordinator_->CompleteTask(session, **lease, *result).ok());
      ++done;
    }
    return done;
  }

  GarbageReport Collect(double unused_s = 0.0, bool dry_run = false) {
    const auto report = coordinator_->CollectGarbage({.unused_s = unused_s, .dry_run = dry_run});
    EXPECT_TRUE(report.ok()) << report.status();
    return report.value_or(GarbageReport{});
  }

  /// Whether the job is done, or goes on to its end, and says so.
  void ExpectAnswer(const Digest& job, const std::string& answer) {
    EXPECT_EQ(WaitForEnd(*coordinator_, job)->state, JobState::kDone);
    EXPECT_EQ(*ToyAnswer(*coordinator_, job), answer);
  }

  TemporaryFolder folder_;
  SteadyClock clock_;
  testing::StageMap stages_ = ToyStages();
  std::unique_ptr<Coordinator> coordinator_;
};

TEST_F(CollectGarbageTest, WhatAFinishedJobHasStays) {
  const Digest job = Submit("1 2 3");
  ASSERT_EQ(Work(5), 5);
  const Digest stray = *coordinator_->Put("stray");
  const GarbageReport report = Collect();
  EXPECT_EQ(report.removed_blobs, 1U);
  EXPECT_EQ(report.removed_bytes, 5U);
  EXPECT_FALSE(coordinator_->StatBlobs({stray})->at(0));
  Restart();
  ExpectAnswer(job, "14");
  EXPECT_EQ(Work(1), 0) << "nothing is computed again";
  EXPECT_EQ(Collect().removed_blobs, 0U);
}

TEST_F(CollectGarbageTest, WhatARunningJobNeedsStays) {
  const Digest job = Submit("1 2 3");
  for (int done = 0; done < 5; ++done) {
    EXPECT_EQ(Collect().removed_blobs, 0U) << "after " << done << " tasks";
    ASSERT_EQ(Work(1), 1);
  }
  ExpectAnswer(job, "14");
}

TEST_F(CollectGarbageTest, WhatACancelledJobDidStaysForItToGoOn) {
  const Digest job = Submit("1 2 3");
  ASSERT_EQ(Work(3), 3);
  ASSERT_TRUE(coordinator_->CancelJob(job).ok());
  Restart();
  EXPECT_EQ(Collect().removed_blobs, 0U);
  Submit("1 2 3");
  EXPECT_EQ(Work(5), 2) << "three were done";
  ExpectAnswer(job, "14");
}

TEST_F(CollectGarbageTest, OfAForgottenJobOnlyWhatOthersHaveStays) {
  const Digest forgotten = Submit("1 2");
  ASSERT_EQ(Work(4), 4);
  const Digest kept = Submit("2 3");
  ASSERT_EQ(Work(3), 3) << "the square of 2 was known";
  ASSERT_TRUE(coordinator_->ForgetJob(forgotten).ok());
  EXPECT_TRUE(absl::IsNotFound(coordinator_->GetJob(forgotten).status()));
  const GarbageReport report = Collect();
  EXPECT_GT(report.removed_blobs, 0U);
  EXPECT_EQ(report.forgotten_results, 3U) << "split, the square of 1, sum";
  Restart();
  EXPECT_EQ(coordinator_->ListJobs()->size(), 1U);
  ExpectAnswer(kept, "13");
  EXPECT_EQ(Work(1), 0);
  Submit("1 2");
  EXPECT_EQ(Work(5), 3) << "all but the square of 2";
  ExpectAnswer(forgotten, "5");
}

TEST_F(CollectGarbageTest, ARunningJobIsNotForgotten) {
  const Digest job = Submit("1");
  EXPECT_TRUE(absl::IsFailedPrecondition(coordinator_->ForgetJob(job)));
  EXPECT_TRUE(absl::IsNotFound(coordinator_->ForgetJob(DigestOf("job"))));
  EXPECT_EQ(coordinator_->ListJobs()->size(), 1U);
}

TEST_F(CollectGarbageTest, WhatListsNameStays) {
  const Digest image = *coordinator_->Put("image");
  const Digest recipe = *coordinator_->Put("number of bytes:" + BytesOf(image) + "and more");
  const JobSpec listed{.kind = "listed",
                       .inputs = {*coordinator_->Put(EncodeCollection({recipe}))}};
  ASSERT_TRUE(coordinator_->SubmitJob(listed).ok());
  const Digest mask = *coordinator_->Put("mask");
  const JobSpec named{.kind = "toy", .inputs = {*coordinator_->Put("m" + BytesOf(mask))}};
  ASSERT_TRUE(coordinator_->SubmitJob(named).ok());
  EXPECT_EQ(Collect().removed_blobs, 0U);
}

TEST_F(CollectGarbageTest, WhatWasUsedLatelyStays) {
  (void)*coordinator_->Put("stray");
  const GarbageReport report = Collect(3600.0);
  EXPECT_EQ(report.recent_blobs, 1U);
  EXPECT_EQ(report.recent_bytes, 5U);
  EXPECT_EQ(report.removed_blobs, 0U);
}

TEST_F(CollectGarbageTest, ADryRunSaysWhatWouldGoAndRemovesNothing) {
  const Digest stray = *coordinator_->Put("stray");
  Submit("1 2");
  const GarbageReport dry = Collect(0.0, true);
  EXPECT_TRUE(coordinator_->StatBlobs({stray})->at(0));
  const GarbageReport real = Collect();
  EXPECT_EQ(dry.removed_blobs, real.removed_blobs);
  EXPECT_EQ(dry.removed_bytes, real.removed_bytes);
  EXPECT_EQ(dry.needed_blobs, real.needed_blobs);
}

TEST_F(CollectGarbageTest, RemovesNothingWhileWhatAJobNeedsCannotBeTold) {
  const Digest stray = *coordinator_->Put("stray");
  const std::string list = EncodeCollection({*coordinator_->Put("3")});
  const JobSpec spec{.kind = "listed", .inputs = {*coordinator_->Put(list)}};
  ASSERT_TRUE(coordinator_->SubmitJob(spec).ok());
  const std::string hex = DigestOf(list).ToHex();
  std::filesystem::remove(folder_ / ("blobs/" + hex.substr(0, 2) + "/" + hex));
  const auto report = coordinator_->CollectGarbage({.unused_s = 0.0});
  EXPECT_TRUE(absl::IsFailedPrecondition(report.status()));
  EXPECT_THAT(std::string(report.status().message()), HasSubstr(spec.Id().ToShortHex()));
  EXPECT_TRUE(coordinator_->StatBlobs({stray})->at(0));
}

TEST_F(CollectGarbageTest, ACrashInItsMiddleIsHarmless) {
  const Digest job = Submit("1 2");
  ASSERT_EQ(Work(4), 4);
  ASSERT_TRUE(coordinator_->ForgetJob(job).ok());
  coordinator_.reset();
  {  // it came as far as some of the blobs
    auto blobs = BlobStore::Open(folder_ / "blobs");
    ASSERT_TRUE(blobs.ok());
    const std::vector<StoredBlob> all = *blobs->List();
    for (size_t i = 0; i < all.size(); i += 2) EXPECT_TRUE(blobs->RemoveUnused(all[i].digest, 0.0));
  }
  Restart();
  Submit("1 2");
  EXPECT_GT(Work(5), 0);
  ExpectAnswer(job, "5");
  EXPECT_EQ(Collect().removed_blobs, 0U);
}

}  // namespace
}  // namespace orbweave
