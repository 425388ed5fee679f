// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/job_needs.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "coordinator/prepare_stage.h"
#include "core/pipeline/loop_guard.h"

namespace orbweave {
namespace {

/// Its recipes name what the tasks of the next stage read.
void AddResult(const TaskResult& result, JobNeeds& needs) {
  needs.blobs.insert(result.outputs.begin(), result.outputs.end());
  needs.blobs.insert(result.recipes.begin(), result.recipes.end());
  needs.lists.insert(result.recipes.begin(), result.recipes.end());
}

/// What a planned stage reads; its tasks.
std::vector<Digest> AddStage(const StageRule& rule, const StagePlan& stage, JobNeeds& needs) {
  std::vector<Digest> ids;
  for (const std::string& collection : stage.collections) needs.blobs.insert(DigestOf(collection));
  for (const TaskSpec& task : stage.tasks) {
    needs.blobs.insert(task.inputs.begin(), task.inputs.end());
    if (rule.parts_listed_in) needs.lists.insert(task.inputs.begin(), task.inputs.end());
    ids.push_back(task.Id());
  }
  needs.tasks.insert(ids.begin(), ids.end());
  return ids;
}

/// Adds the blobs of `stored` whose names stand in `bytes`.
void AddNamesIn(std::string_view bytes,
                const std::unordered_set<Digest>& stored,
                std::unordered_set<Digest>& blobs) {
  Digest digest;
  for (size_t begin = 0; begin + digest.bytes.size() <= bytes.size(); ++begin) {
    std::copy_n(
        bytes.begin() + static_cast<ptrdiff_t>(begin), digest.bytes.size(), digest.bytes.begin());
    if (stored.contains(digest)) blobs.insert(digest);
  }
}

}  // namespace

absl::Status AddNeedsOf(const JobSpec& spec,
                        const JobPlan& plan,
                        BlobAccess& blobs,
                        Journal& journal,
                        JobNeeds& needs) {
  needs.blobs.insert(spec.inputs.begin(), spec.inputs.end());
  needs.lists.insert(spec.inputs.begin(), spec.inputs.end());
  JobSnapshot snapshot{.spec = spec, .plan = plan};
  LoopGuard loops;  // results of a loop that never ended are all there
  while (snapshot.stage < plan.stages.size()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const StagePlan stage, PlanSnapshot(snapshot, blobs));
    if (!loops.Enter(plan, snapshot.stage, stage.tasks).ok()) break;
    const std::vector<Digest> ids = AddStage(plan.stages[snapshot.stage], stage, needs);
    ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<std::optional<TaskResult>> found,
                              journal.LoadResults(ids));
    std::vector<TaskResult> results;
    for (const std::optional<TaskResult>& result : found) {
      if (result) AddResult(results.emplace_back(*result), needs);
    }
    if (results.size() < ids.size()) break;
    if (snapshot.results.size() <= snapshot.stage) snapshot.results.resize(snapshot.stage + 1);
    snapshot.results[snapshot.stage] = std::move(results);
    snapshot.stage = StageAfter(plan, snapshot.stage, snapshot.results[snapshot.stage]);
  }
  return absl::OkStatus();
}

absl::Status AddNamedBlobs(const std::unordered_set<Digest>& stored,
                           BlobAccess& blobs,
                           JobNeeds& needs) {
  for (const Digest& list : needs.lists) {
    if (!stored.contains(list)) continue;
    const absl::StatusOr<std::string> bytes = blobs.Get(list);
    if (bytes.ok()) {
      AddNamesIn(*bytes, stored, needs.blobs);
    } else if (!absl::IsNotFound(bytes.status()) && !absl::IsDataLoss(bytes.status())) {
      return bytes.status();
    }
  }
  return absl::OkStatus();
}

}  // namespace orbweave
