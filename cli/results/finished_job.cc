// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/results/finished_job.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>
#include <vector>

#include "cli/arguments/store_argument.h"
#include "coordinator/journal/journal_copy.h"
#include "stages/codecs.h"
#include "stages/conclude_adjustment/stage.h"
#include "stages/plans.h"

namespace orbweave {
namespace {

/// Whether a job that has no workers cannot go on: a stage is written down and not done.
bool NeedsWorkers(const JobStatus& job) {
  return std::any_of(job.stages.begin(), job.stages.end(), [](const StageStatus& stage) {
    return stage.tasks_total > stage.tasks_done;
  });
}

/// The job once a coordinator that has just been opened has found its finished tasks again.
absl::StatusOr<JobStatus> Settled(JobApi& coordinator, const Digest& id) {
  constexpr auto kPause = std::chrono::milliseconds(20);
  for (;;) {
    ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus job, coordinator.GetJob(id));
    if (job.state != JobState::kRunning || NeedsWorkers(job)) return job;
    std::this_thread::sleep_for(kPause);
  }
}

/// Whether jobs of its kind conclude a model; dense ones read one and leave none.
bool LeavesAModel(const JobStatus& job) {
  const absl::StatusOr<JobPlan> plan = FindJobPlan(job.spec.kind);
  return plan.ok() &&
         std::ranges::find(plan->stages, ConcludeAdjustmentStage::kFacts.name, &StageRule::stage) !=
             plan->stages.end();
}

}  // namespace

absl::Status CheckHoldsJob(const std::string& output) {
  std::error_code error;
  if (std::filesystem::is_directory(output + "/.orbweave", error)) return absl::OkStatus();
  return absl::NotFoundError(output + " is not the output folder of a job (no .orbweave in it)");
}

absl::StatusOr<std::unique_ptr<Coordinator>> OpenFinished(const std::string& output,
                                                          const Clock& clock) {
  ORBWEAVE_RETURN_IF_ERROR(CheckHoldsJob(output));
  const std::string state = output + "/.orbweave";
  CoordinatorOptions options{.state_dir = state, .leases_survive = false, .find_plan = FindJobPlan};
  ORBWEAVE_ASSIGN_OR_RETURN(const StoreArgument store, RememberedStore(state));
  ORBWEAVE_RETURN_IF_ERROR(store.OpenFor(options));
  if (!SharedFileSystemOf(state).empty()) options.open_journal = OpenJournalToLook;
  return Coordinator::Open(options, clock);
}

absl::StatusOr<JobStatus> LastFinishedJob(JobApi& coordinator, const std::string& output) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<JobStatus> jobs, coordinator.ListJobs());
  for (auto listed = jobs.rbegin(); listed != jobs.rend(); ++listed) {
    ORBWEAVE_ASSIGN_OR_RETURN(JobStatus job, Settled(coordinator, listed->id));
    if (job.state == JobState::kDone && LeavesAModel(job)) return job;
  }
  return absl::FailedPreconditionError(output + " holds no finished job; run it to its end first");
}

}  // namespace orbweave
