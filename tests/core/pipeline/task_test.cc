// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/task.h"

#include <gtest/gtest.h>

#include "core/pipeline/job_api.h"
#include "core/pipeline/job_plan.h"

namespace orbweave {
namespace {

TaskSpec ExampleTask() {
  return {.stage = "match_images",
          .version = "4",
          .inputs = {DigestOf("a"), DigestOf("b")},
          .options_text = "matching.max_ratio=0.8\n"};
}

TEST(TaskSpec, IdChangesWithStageVersionInputsAndOptions) {
  const Digest id = ExampleTask().Id();
  TaskSpec other_stage = ExampleTask();
  other_stage.stage = "align_submodels";
  TaskSpec other_version = ExampleTask();
  other_version.version = "5";
  TaskSpec swapped = ExampleTask();
  std::swap(swapped.inputs[0], swapped.inputs[1]);
  TaskSpec other_options = ExampleTask();
  other_options.options_text = "matching.max_ratio=0.9\n";
  EXPECT_EQ(ExampleTask().Id(), id);
  EXPECT_NE(other_stage.Id(), id);
  EXPECT_NE(other_version.Id(), id);
  EXPECT_NE(swapped.Id(), id);
  EXPECT_NE(other_options.Id(), id);
}

TEST(TaskSpec, IdDoesNotChangeWithPart) {
  TaskSpec other_part = ExampleTask();
  other_part.part = 7;
  EXPECT_EQ(other_part.Id(), ExampleTask().Id());
}

TEST(JobSpec, IdDoesNotChangeWithLabelButWithAllElse) {
  const JobSpec job{
      .kind = "sparse", .inputs = {DigestOf("a")}, .options_text = "x.y=1\n", .label = "one"};
  JobSpec relabelled = job;
  relabelled.label = "two";
  JobSpec other_options = job;
  other_options.options_text = "x.y=2\n";
  JobSpec other_inputs = job;
  other_inputs.inputs.push_back(DigestOf("b"));
  EXPECT_EQ(relabelled.Id(), job.Id());
  EXPECT_NE(other_options.Id(), job.Id());
  EXPECT_NE(other_inputs.Id(), job.Id());
}

}  // namespace
}  // namespace orbweave
