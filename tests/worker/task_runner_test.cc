// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/task_runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

#include "tests/support/manual_clock.h"
#include "tests/support/toy_job.h"
#include "worker/peak_memory.h"

namespace orbweave {
namespace {

class OneBlob final : public BlobAccess {
 public:
  absl::StatusOr<std::string> Get(const Digest& digest) override {
    if (digest == DigestOf("pixels")) return "pixels";
    return absl::NotFoundError("no such blob here");
  }
  absl::StatusOr<Digest> Put(std::string_view bytes) override { return DigestOf(bytes); }
};

absl::StatusOr<TaskResult> RunStage(const StageFunction& stage,
                                    const Clock& clock = ManualClock()) {
  const testing::StageMap stages = {{"stage", stage}};
  OneBlob blobs;
  return RunTask(testing::LookupIn(stages), {.stage = "stage"}, blobs, {}, clock);
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
  EXPECT_DOUBLE_EQ(result->cost.wall_s, 3.0);
  EXPECT_GE(result->cost.cpu_s, 0.0);
  EXPECT_EQ(result->report_json, "{}");
}

TEST(RunTask, CountsTheBytesOfBlobsThatTheTaskGotAndPut) {
  const auto result = RunStage(
      [](const TaskSpec&, BlobAccess& blobs, const StageContext&) -> absl::StatusOr<TaskResult> {
        EXPECT_FALSE(blobs.Get(DigestOf("lost")).ok());
        EXPECT_EQ(blobs.Get(DigestOf("pixels"))->size(), 6U);
        EXPECT_TRUE(blobs.Put("a model").ok());
        EXPECT_TRUE(blobs.Put("!").ok());
        return TaskResult{};
      });
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->cost.bytes_in, 6U);
  EXPECT_EQ(result->cost.bytes_out, 8U);
}

TEST(PeakMemory, GrowsWithWhatIsHeldAndStartsAnew) {
  constexpr size_t kLarge = size_t{256} << 20;
  RestartPeakMemory();
  const uint64_t before = PeakMemoryBytes();
  ASSERT_GT(before, 0U);
  { const std::string held(kLarge, 'x'); }
  EXPECT_GE(PeakMemoryBytes(), before + kLarge * 9 / 10);
  RestartPeakMemory();
  EXPECT_LT(PeakMemoryBytes(), before + kLarge / 2);
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
  OneBlob blobs;
  const auto result =
      RunTask(testing::LookupIn(stages), {.stage = "juggle"}, blobs, {}, ManualClock());
  EXPECT_TRUE(absl::IsUnimplemented(result.status()));
  EXPECT_THAT(std::string(result.status().message()), ::testing::HasSubstr("juggle"));
}

}  // namespace
}  // namespace orbweave
