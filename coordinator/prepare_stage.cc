// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/prepare_stage.h"

#include <algorithm>

namespace orbweave {
namespace {

bool IsComplete(const TaskResult& result, bool verify, KeptBlobs& blobs) {
  const auto is_there = [&](const Digest& blob) {
    return blobs.Use(blob) && (!verify || blobs.Verify(blob));
  };
  return std::all_of(result.outputs.begin(), result.outputs.end(), is_there) &&
         std::all_of(result.recipes.begin(), result.recipes.end(), is_there);
}

}  // namespace

absl::StatusOr<StagePlan> PlanSnapshot(const JobSnapshot& snapshot, BlobAccess& blobs) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> listed,
                            ReadListedRecipes(snapshot.plan, snapshot.stage, snapshot.spec, blobs));
  return PlanStage(snapshot.plan, snapshot.stage, snapshot.spec, snapshot.results, listed);
}

absl::StatusOr<PreparedStage> PrepareStage(const JobSnapshot& snapshot,
                                           KeptBlobs& blobs,
                                           Journal& journal) {
  ORBWEAVE_ASSIGN_OR_RETURN(StagePlan plan, PlanSnapshot(snapshot, blobs));
  for (const std::string& collection : plan.collections) {
    ORBWEAVE_RETURN_IF_ERROR(blobs.Put(collection).status());
  }
  if (snapshot.verify) ORBWEAVE_RETURN_IF_ERROR(blobs.Refresh());
  PreparedStage prepared{.tasks = std::move(plan.tasks)};
  std::vector<Digest> ids;
  for (const TaskSpec& task : prepared.tasks) ids.push_back(task.Id());
  ORBWEAVE_ASSIGN_OR_RETURN(prepared.found, journal.LoadResults(ids));
  for (std::optional<TaskResult>& found : prepared.found) {
    if (found && !IsComplete(*found, snapshot.verify, blobs)) found.reset();
  }
  return prepared;
}

}  // namespace orbweave
