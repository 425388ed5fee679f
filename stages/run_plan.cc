// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/run_plan.h"

#include <map>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/pipeline/loop_guard.h"
#include "core/pipeline/plan_stage.h"
#include "stages/plans.h"
#include "stages/registry.h"

namespace orbweave {
namespace {

/// Results by the ids of their tasks: a loop may ask for the same again.
using KnownResults = std::map<Digest, TaskResult>;

absl::StatusOr<TaskResult> RunOne(const TaskSpec& task,
                                  const StageLookup& stages,
                                  BlobAccess& blobs,
                                  const StageContext& context,
                                  KnownResults& known) {
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  if (const auto found = known.find(task.Id()); found != known.end()) return found->second;
  StageContext seeded = context;
  seeded.seed = task.Id().ToSeed();
  absl::StatusOr<TaskResult> result = CallStage(stages, task, blobs, seeded);
  if (result.ok()) return known[task.Id()] = *std::move(result);
  return Annotate(result.status(), absl::StrCat("stage ", task.stage, ", part ", task.part));
}

}  // namespace

absl::StatusOr<std::vector<TaskOutcome>> RunPlan(const JobPlan& plan,
                                                 const JobSpec& job,
                                                 const StageLookup& stages,
                                                 BlobAccess& blobs,
                                                 const StageContext& context) {
  LoopGuard loops;
  KnownResults known;
  std::vector<std::vector<TaskResult>> results(plan.stages.size());
  std::vector<std::vector<TaskOutcome>> outcomes(plan.stages.size());
  for (uint32_t s = 0; s < plan.stages.size(); s = StageAfter(plan, s, results[s])) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> listed,
                              ReadListedRecipes(plan, s, job, blobs));
    ORBWEAVE_ASSIGN_OR_RETURN(const StagePlan stage, PlanStage(plan, s, job, results, listed));
    ORBWEAVE_RETURN_IF_ERROR(loops.Enter(plan, s, stage.tasks));
    for (const std::string& collection : stage.collections)
      ORBWEAVE_RETURN_IF_ERROR(blobs.Put(collection).status());
    results[s].clear();
    outcomes[s].clear();
    for (const TaskSpec& task : stage.tasks) {
      ORBWEAVE_ASSIGN_OR_RETURN(TaskResult result, RunOne(task, stages, blobs, context, known));
      results[s].push_back(result);
      outcomes[s].push_back({task.stage, task.part, task.Id(), std::move(result)});
    }
  }
  std::vector<TaskOutcome> all;
  for (std::vector<TaskOutcome>& of_stage : outcomes)
    std::move(of_stage.begin(), of_stage.end(), std::back_inserter(all));
  return all;
}

absl::StatusOr<std::vector<TaskOutcome>> RunJob(const JobSpec& job,
                                                BlobAccess& blobs,
                                                const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const JobPlan plan, FindJobPlan(job.kind));
  return RunPlan(plan, job, FindStageFunction, blobs, context);
}

}  // namespace orbweave
