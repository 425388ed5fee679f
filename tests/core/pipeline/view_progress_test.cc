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

TEST(ViewProgress, LearnsNothingFromTasksThatWereFound) {
  JobStatus status = TwoStages();
  status.stages[0].tasks_reused = 4;
  status.stages[0].busy_s = 0.0;
  EXPECT_DOUBLE_EQ(ViewProgress(status).eta_s, 10.0);
  status.stages[1].tasks_reused = 4;
  status.stages[1].fraction_running = 0.0;
  status.stages[1].busy_s = 0.0;
  EXPECT_LT(ViewProgress(status).eta_s, 0.0);
}

TEST(ViewProgress, SharesWhatIsLeftAmongTheSlotsThereAre) {
  JobStatus status = TwoStages();
  status.slots = 5;
  EXPECT_DOUBLE_EQ(ViewProgress(status).eta_s, 2.0);
  status.stages[1].has_parts = false;
  EXPECT_DOUBLE_EQ(ViewProgress(status).eta_s, 10.0);
}

/// 20 s for weight 1 and 8 s for four tenths of weight 1: 20 s for each weight to come.
TEST(ViewProgress, ExpectsOfStagesToComeWhatTheirWeightCostSoFar) {
  JobStatus status = TwoStages();
  status.stages.push_back({.stage = "last", .weight = 0.5});
  EXPECT_DOUBLE_EQ(ViewProgress(status).eta_s, 10.0 + 0.5 * 20.0);
}

/// Weights that are wrong for a job do not outlive the tasks that show it.
TEST(ViewProgress, BelievesTasksMoreThanWeights) {
  JobStatus status = TwoStages();
  status.stages[1].weight = 1000.0;
  EXPECT_DOUBLE_EQ(ViewProgress(status).eta_s, 10.0);
}

TEST(ViewProgress, PassesAStageWithoutTasks) {
  JobStatus status = TwoStages();
  status.stages.insert(status.stages.begin(), StageStatus{.stage = "empty"});
  EXPECT_EQ(ViewProgress(status).stage, "second");
}

/// In the third of some 26 rounds of a loop of four parts; each took a second of one stage and four
/// of the other.
JobStatus ThirdRound() {
  return {.elapsed_s = 30.0,
          .stages = {{.stage = "before", .tasks_total = 4, .tasks_done = 4, .busy_s = 1.0},
                     {.stage = "steer",
                      .tasks_total = 3,
                      .tasks_done = 3,
                      .usual_runs = 26.0,
                      .runs = 3,
                      .busy_s = 3.0},
                     {.stage = "work",
                      .tasks_total = 12,
                      .tasks_done = 8,
                      .usual_runs = 26.0,
                      .runs = 3,
                      .busy_s = 8.0,
                      .has_parts = true},
                     {.stage = "after", .weight = 0.0}}};
}

TEST(ViewProgress, DoesNotTakeARoundOfALoopForItsEnd) {
  JobStatus status = ThirdRound();
  const double third = ViewProgress(status).fraction;
  EXPECT_EQ(ViewProgress(status).stage, "work");
  EXPECT_LT(third, 0.8);
  status.stages[2].tasks_done = 12;
  status.stages[1].tasks_total = 4;
  status.stages[1].runs = 4;
  EXPECT_EQ(ViewProgress(status).stage, "steer");
  EXPECT_GT(ViewProgress(status).fraction, third);
  status.stages[1].tasks_done = 4;
  status.stages[3] = {.stage = "after", .tasks_total = 1};
  EXPECT_EQ(ViewProgress(status).stage, "after");
  EXPECT_GT(ViewProgress(status).fraction, 0.7);
}

/// 23 rounds to come, each a second of the one stage and 8/3 of the other, and four tasks of a
/// second in this one.
TEST(ViewProgress, ExpectsTheRoundsThatALoopUsuallyHas) {
  JobStatus status = ThirdRound();
  EXPECT_DOUBLE_EQ(ViewProgress(status).eta_s, 23.0 + 23.0 * 8.0 / 3.0 + 4.0);
  status.slots = 100;
  EXPECT_DOUBLE_EQ(ViewProgress(status).eta_s, 23.0 + (23.0 * 8.0 / 3.0 + 4.0) / 4.0)
      << "no more than four are at work at a time";
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
