// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What becomes of a job whose tasks leave what others cannot read.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "coordinator/coordinator.h"
#include "core/pipeline/build_version.h"
#include "core/pipeline/damaged_blob.h"
#include "tests/support/command.h"
#include "tests/support/toy_job.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::ToyStages;

constexpr char kNoNumber[] = "no number";

/// Sums as the toy stage does, and says which square is none.
absl::StatusOr<TaskResult> CarefulSum(const TaskSpec& spec,
                                      BlobAccess& blobs,
                                      const StageContext& context) {
  const auto squares = DecodeCollection(*blobs.Get(spec.inputs.at(0)));
  for (const Digest& square : *squares) {
    if (*blobs.Get(square) == kNoNumber)
      return BlameBlob(absl::DataLossError("a square that is no number"), square);
  }
  return testing::Sum(spec, blobs, context);
}

/// The same without saying which.
absl::StatusOr<TaskResult> VagueSum(const TaskSpec& spec,
                                    BlobAccess& blobs,
                                    const StageContext& context) {
  const absl::StatusOr<TaskResult> sum = CarefulSum(spec, blobs, context);
  if (sum.ok()) return sum;
  return absl::DataLossError(sum.status().message());
}

/// Workers that are driven call by call, of which those named "bad" leave squares that are none.
class DamagedResults : public ::testing::Test {
 protected:
  DamagedResults() {
    stages_["sum"] = CarefulSum;
    Open();
  }

  void Open() {
    coordinator_.reset();
    auto opened = Coordinator::Open({.state_dir = folder_ / "state",
                                     .retry = {.first_wait_s = 0.0},
                                     .find_plan = testing::FindToyPlan},
                                    clock_);
    ORBWEAVE_CHECK(opened.ok());
    coordinator_ = *std::move(opened);
  }

  uint64_t Join(const std::string& name) {
    return coordinator_->Join({.name = name, .version = std::string(BuildVersion()), .process = 7})
        ->session;
  }

  Digest Submit(const std::string& numbers) {
    return *coordinator_->SubmitJob(*testing::PrepareToyJob(*coordinator_, numbers));
  }

  /// Does what it is given, if anything is.
  void Work(uint64_t session, bool is_bad) {
    const auto lease = coordinator_->LeaseTask(session, 0, 0.01);
    ORBWEAVE_CHECK(lease.ok());
    if (!*lease) return;
    const TaskSpec& spec = (*lease)->spec;
    ++runs_;
    absl::StatusOr<TaskResult> result = stages_.at(spec.stage)(spec, *coordinator_, {});
    if (is_bad && spec.stage == "square") result->outputs = {*coordinator_->Put(kNoNumber)};
    const absl::Status answer = result.ok()
                                    ? coordinator_->CompleteTask(session, **lease, *result)
                                    : coordinator_->FailTask(session, **lease, result.status());
    EXPECT_TRUE(answer.ok()) << answer;
  }

  JobStatus Finish(const Digest& job, const std::vector<std::pair<uint64_t, bool>>& workers) {
    for (int i = 0; i < 2000; ++i) {
      const JobStatus status = *coordinator_->GetJob(job);
      if (status.state != JobState::kRunning) return status;
      for (const auto& [session, is_bad] : workers) Work(session, is_bad);
    }
    return *coordinator_->GetJob(job);
  }

  bool IsSetAside(const std::string& name) {
    const auto workers = coordinator_->ListWorkers();
    return std::ranges::any_of(*workers, [&](const WorkerStatus& worker) {
      return worker.name == name && worker.set_aside;
    });
  }

  TemporaryFolder folder_;
  SteadyClock clock_;
  testing::StageMap stages_ = ToyStages();
  std::unique_ptr<Coordinator> coordinator_;
  int runs_ = 0;
};

TEST_F(DamagedResults, AreMadeAgainByOthersAndTheJobEndsWell) {
  const uint64_t bad = Join("bad");
  const uint64_t good = Join("good");
  const Digest job = Submit("1 2 3");
  const JobStatus status = Finish(job, {{bad, true}, {good, false}});
  ASSERT_EQ(status.state, JobState::kDone) << status.error;
  EXPECT_EQ(*testing::ToyAnswer(*coordinator_, job), "14");
}

TEST_F(DamagedResults, CountAgainstWhoLeftThem) {
  const uint64_t bad = Join("bad");
  const uint64_t good = Join("good");
  for (const char* numbers : {"1 2", "3 4", "5 6", "7 8"}) {
    const Digest job = Submit(numbers);
    // The bad one does the squares alone, and nothing well in between.
    while (coordinator_->GetJob(job)->stages[0].tasks_done == 0) Work(good, false);
    while (coordinator_->GetJob(job)->stages[1].tasks_done < 2 && !IsSetAside("bad"))
      Work(bad, true);
    EXPECT_EQ(Finish(job, {{good, false}}).state, JobState::kDone);
    EXPECT_FALSE(IsSetAside("good"));
  }
  EXPECT_TRUE(IsSetAside("bad"));
}

TEST_F(DamagedResults, FailTheJobByNameWhenNobodyDoesBetter) {
  const uint64_t bad = Join("bad");
  const Digest job = Submit("1");
  const JobStatus status = Finish(job, {{bad, true}});
  ASSERT_EQ(status.state, JobState::kFailed);
  EXPECT_THAT(status.error, HasSubstr("stage square, part 0"));
  EXPECT_THAT(status.error, HasSubstr("last on bad"));
  EXPECT_THAT(status.error, HasSubstr("which stage sum, part 0"));
  EXPECT_THAT(status.error, HasSubstr("a square that is no number"));
  EXPECT_LT(runs_, 12) << "a few times, not for ever";
}

TEST_F(DamagedResults, BlameNobodyWhoseBytesOthersLeaveAsWell) {
  const std::vector<std::pair<uint64_t, bool>> workers = {
      {Join("a"), true}, {Join("b"), true}, {Join("c"), true}};
  for (const char* numbers : {"1", "2", "3", "4"}) {
    const Digest job = Submit(numbers);
    EXPECT_EQ(Finish(job, workers).state, JobState::kFailed);
  }
  for (const char* name : {"a", "b", "c"}) EXPECT_FALSE(IsSetAside(name)) << name;
}

TEST_F(DamagedResults, AreForgottenForGood) {
  const uint64_t bad = Join("bad");
  const uint64_t good = Join("good");
  const Digest job = Submit("1 2 3");
  while (coordinator_->GetJob(job)->stages[0].tasks_done == 0) Work(good, false);
  while (coordinator_->GetJob(job)->stages[1].tasks_done < 3) Work(bad, true);
  while (coordinator_->GetJob(job)->stages[1].tasks_done == 3) Work(good, false);
  ASSERT_TRUE(testing::WaitUntil(
      [&] { return coordinator_->GetJob(job)->stages[1].tasks_total == 3; }, 20.0));
  Open();
  EXPECT_EQ(Finish(job, {{Join("good"), false}}).state, JobState::kDone);
  EXPECT_EQ(*testing::ToyAnswer(*coordinator_, job), "14");
}

TEST_F(DamagedResults, OfWhichNobodyKnowsWhichAreAllMadeAgainOnce) {
  stages_["sum"] = VagueSum;
  const uint64_t bad = Join("bad");
  const uint64_t good = Join("good");
  const Digest job = Submit("1 2 3");
  while (coordinator_->GetJob(job)->stages[0].tasks_done == 0) Work(good, false);
  while (coordinator_->GetJob(job)->stages[1].tasks_done < 3) Work(bad, true);
  const JobStatus status = Finish(job, {{good, false}});
  ASSERT_EQ(status.state, JobState::kDone) << status.error;
  EXPECT_EQ(*testing::ToyAnswer(*coordinator_, job), "14");
  EXPECT_FALSE(IsSetAside("bad")) << "nobody knows";
}

TEST_F(DamagedResults, OfWhichNobodyKnowsWhichFailTheJobAtLast) {
  stages_["sum"] = VagueSum;
  const Digest job = Submit("1 2 3");
  const JobStatus status = Finish(job, {{Join("bad"), true}});
  ASSERT_EQ(status.state, JobState::kFailed);
  EXPECT_THAT(status.error, HasSubstr("stage sum, part 0"));
  EXPECT_LT(runs_, 30);
}

}  // namespace
}  // namespace orbweave
