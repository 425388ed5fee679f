// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// A whole job on the matches of a made-up street, in one process and by workers.

#include "stages/run_plan.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "coordinator/coordinator.h"
#include "stages/conclude_adjustment/stage.h"
#include "stages/job_reader.h"
#include "stages/plans.h"
#include "stages/registry.h"
#include "tests/support/command.h"
#include "tests/support/in_process_executor.h"
#include "tests/support/memory_blobs.h"
#include "tests/support/street_job.h"
#include "worker/worker_loop.h"

namespace orbweave {
namespace {

constexpr uint32_t kPanoramas = 36;

/// A street in three clusters, adjusted in subproblems that meet in separators.
JobSpec StreetJob(BlobAccess& blobs) {
  return testing::StreetJob(
      {.panoramas = kPanoramas, .features_per_panorama = 150},
      {"partition.cluster_size=12", "partition.overlap=4", "blocks.distribute_from=10"},
      blobs);
}

/// Every task of the last round of each stage with all that it left.
std::vector<std::string> LinesOf(const std::vector<TaskOutcome>& outcomes) {
  std::vector<std::string> lines;
  for (const TaskOutcome& outcome : outcomes) {
    std::string& line = lines.emplace_back(outcome.stage + " " + std::to_string(outcome.part));
    line += " " + outcome.id.ToShortHex() + ":";
    for (const Digest& output : outcome.result.outputs) line += " " + output.ToShortHex();
    for (const Digest& recipe : outcome.result.recipes) line += " " + recipe.ToShortHex();
  }
  return lines;
}

std::vector<TaskOutcome> OutcomesOfWorkers() {
  const testing::TemporaryFolder folder;
  const SteadyClock clock;
  const auto coordinator =
      Coordinator::Open({.state_dir = folder / "state", .find_plan = FindJobPlan}, clock);
  EXPECT_TRUE(coordinator.ok()) << coordinator.status();
  const Digest job = (*coordinator)->SubmitJob(StreetJob(**coordinator)).value();
  const StageLookup stages = FindStageFunction;
  {
    std::vector<std::jthread> workers;
    for (const char* name : {"one", "two"}) {
      workers.emplace_back([&, name](const std::stop_token& stop) {
        const WorkerOptions options{.name = name, .grace_s = 0.0, .poll_s = 0.05};
        (void)RunWorker(
            **coordinator, **coordinator, testing::RunInProcess(stages, clock), options, stop);
      });
    }
    EXPECT_TRUE(testing::WaitUntil(
        [&] { return (*coordinator)->GetJob(job)->state != JobState::kRunning; }, 200.0));
  }
  const JobStatus status = (*coordinator)->GetJob(job).value();
  EXPECT_EQ(status.state, JobState::kDone) << status.error;
  (*coordinator)->BeginShutdown();
  return (*coordinator)->GetOutcomes(job).value();
}

TEST(RunJob, LeavesWhatWorkersLeave) {
  testing::MemoryBlobs blobs;
  const JobSpec job = StreetJob(blobs);
  const auto outcomes = RunJob(job, blobs, {});
  ASSERT_TRUE(outcomes.ok()) << outcomes.status();
  const JobPlan plan = FindJobPlan(job.kind).value();
  const auto model =
      JobReader(plan, job, *outcomes, blobs).Read(&ConcludeAdjustmentStage::Outputs::model);
  ASSERT_TRUE(model.ok()) << model.status();
  ASSERT_EQ(model->worlds.size(), 1U);
  EXPECT_EQ(model->worlds[0].images.size(), kPanoramas);
  EXPECT_GE(model->subproblems[0].size(), 3U) << "adjusted in blocks";
  EXPECT_EQ(LinesOf(*outcomes), LinesOf(OutcomesOfWorkers()));
}

TEST(RunJob, RefusesAnUnknownKind) {
  testing::MemoryBlobs blobs;
  EXPECT_TRUE(absl::IsNotFound(RunJob({.kind = "no_such_kind"}, blobs, {}).status()));
}

}  // namespace
}  // namespace orbweave
