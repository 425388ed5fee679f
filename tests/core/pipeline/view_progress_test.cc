// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/view_progress.h"

#include <gtest/gtest.h>

#include "tests/support/two_stages.h"

namespace orbweave {
namespace {

using testing::TwoStages;

TEST(ViewProgress, CountsDoneStagesAndRunningTasks) {
  const ProgressView view = ViewProgress(TwoStages());
  EXPECT_EQ(view.stage, "second");
  EXPECT_DOUBLE_EQ(view.tasks_done, 5.0);
  EXPECT_EQ(view.tasks_total, 10U);
  EXPECT_DOUBLE_EQ(view.fraction, 0.75);
  EXPECT_DOUBLE_EQ(view.tasks_per_s, 0.5);
  EXPECT_DOUBLE_EQ(view.eta_s, 10.0);
}

TEST(ViewProgress, DoesNotLetReusedTasksPromiseSpeed) {
  JobStatus status = TwoStages();
  status.stages[0].tasks_reused = 4;
  EXPECT_DOUBLE_EQ(ViewProgress(status).eta_s, 30.0);
}

TEST(ViewProgress, PassesAStageWithoutTasks) {
  JobStatus status = TwoStages();
  status.stages.insert(status.stages.begin(), StageStatus{.stage = "empty"});
  EXPECT_EQ(ViewProgress(status).stage, "second");
}

/// In the third of some 26 rounds of a global adjustment in four blocks.
JobStatus ThirdRound() {
  return {.elapsed_s = 30.0,
          .stages = {{.stage = "reconstruct_cluster", .tasks_total = 4, .tasks_done = 4},
                     {.stage = "steer_adjustment", .tasks_total = 3, .tasks_done = 3},
                     {.stage = "adjust_block", .tasks_total = 12, .tasks_done = 9},
                     {.stage = "conclude_adjustment"}}};
}

TEST(ViewProgress, DoesNotTakeARoundOfTheAdjustmentForItsEnd) {
  JobStatus status = ThirdRound();
  const double third = ViewProgress(status).fraction;
  EXPECT_EQ(ViewProgress(status).stage, "adjust_block");
  EXPECT_LT(third, 0.8);
  status.stages[2].tasks_done = 12;
  status.stages[1].tasks_total = 4;
  EXPECT_EQ(ViewProgress(status).stage, "steer_adjustment");
  EXPECT_GT(ViewProgress(status).fraction, third);
  status.stages[1].tasks_done = 4;
  status.stages[3].tasks_total = 1;
  EXPECT_EQ(ViewProgress(status).stage, "conclude_adjustment");
  EXPECT_GT(ViewProgress(status).fraction, 0.9);
}

TEST(ViewProgress, KnowsNoEtaAtTheBeginningAndNoStageAtTheEnd) {
  JobStatus status{.stages = {{.stage = "first"}}};
  EXPECT_EQ(ViewProgress(status).stage, "first");
  EXPECT_LT(ViewProgress(status).eta_s, 0.0);
  status.state = JobState::kDone;
  EXPECT_EQ(ViewProgress(status).stage, "");
  EXPECT_DOUBLE_EQ(ViewProgress(status).fraction, 1.0);
}

}  // namespace
}  // namespace orbweave
