// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/task_runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

#include "tests/support/toy_job.h"

namespace orbweave {
namespace {

class NoBlobs final : public BlobAccess {
 public:
  absl::StatusOr<std::string> Get(const Digest&) override {
    return absl::NotFoundError("no blobs here");
  }
  absl::StatusOr<Digest> Put(std::string_view bytes) override { return DigestOf(bytes); }
};

absl::StatusOr<TaskResult> RunStage(const StageFunction& stage,
                                    const Clock& clock = ManualClock()) {
  const testing::StageMap stages = {{"stage", stage}};
  NoBlobs blobs;
  return RunTask(
      testing::LookupIn(stages), {.stage = "stage"}, blobs, {}, clock, CpuClock::kThread);
}

TEST(RunTask, MeasuresWallTime) {
  ManualClock clock;
  const auto result = RunStage(
      [&clock](const TaskSpec&, BlobAccess&, const StageContext&) -> absl::StatusOr<TaskResult> {
        clock.Advance(3.0);
        return TaskResult{.report_json = "{}"};
      },
      clock);
  ASSERT_TRUE(result.ok());
  EXPECT_DOUBLE_EQ(result->wall_s, 3.0);
  EXPECT_GE(result->cpu_s, 0.0);
  EXPECT_EQ(result->report_json, "{}");
}

TEST(RunTask, TurnsExceptionsIntoStatus) {
  const auto thrown =
      RunStage([](const TaskSpec&, BlobAccess&, const StageContext&) -> absl::StatusOr<TaskResult> {
        throw std::runtime_error("matrix is not square");
      });
  EXPECT_TRUE(absl::IsInternal(thrown.status()));
  EXPECT_THAT(std::string(thrown.status().message()), ::testing::HasSubstr("matrix is not square"));
  const auto out_of_memory =
      RunStage([](const TaskSpec&, BlobAccess&, const StageContext&) -> absl::StatusOr<TaskResult> {
        throw std::bad_alloc();
      });
  EXPECT_TRUE(absl::IsResourceExhausted(out_of_memory.status()));
}

TEST(RunTask, PassesOnTheErrorOfTheStage) {
  const auto failed =
      RunStage([](const TaskSpec&, BlobAccess&, const StageContext&) -> absl::StatusOr<TaskResult> {
        return absl::InvalidArgumentError("no images");
      });
  EXPECT_EQ(failed.status(), absl::InvalidArgumentError("no images"));
}

TEST(RunTask, NamesAStageItDoesNotHave) {
  const testing::StageMap stages;
  NoBlobs blobs;
  const auto result = RunTask(
      testing::LookupIn(stages), {.stage = "juggle"}, blobs, {}, ManualClock(), CpuClock::kProcess);
  EXPECT_TRUE(absl::IsUnimplemented(result.status()));
  EXPECT_THAT(std::string(result.status().message()), ::testing::HasSubstr("juggle"));
}

}  // namespace
}  // namespace orbweave
