// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "core/base/parallel_for.h"
#include "core/pipeline/plan_stage.h"
#include "worker/stage_table.h"

/// A whole job without coordinator, network or files: plan, stage table and a map of blobs.

namespace orbweave::testing {

class MemoryBlobs final : public BlobAccess {
 public:
  absl::StatusOr<std::string> Get(const Digest& digest) override {
    const std::lock_guard lock(mutex_);
    const auto found = blobs_.find(digest);
    if (found == blobs_.end()) return absl::NotFoundError("no blob " + digest.ToShortHex());
    return found->second;
  }
  absl::StatusOr<Digest> Put(std::string_view bytes) override {
    const Digest digest = DigestOf(bytes);
    const std::lock_guard lock(mutex_);
    blobs_.try_emplace(digest, bytes);
    return digest;
  }

 private:
  std::mutex mutex_;
  std::map<Digest, std::string> blobs_;
};

struct InProcessJob {
  JobPlan plan{};
  std::vector<std::vector<TaskResult>> results{};  ///< [stage][part]

  [[nodiscard]] const std::vector<TaskResult>& Of(std::string_view stage) const {
    for (size_t s = 0; s < plan.stages.size(); ++s) {
      if (plan.stages[s].stage == stage) return results[s];
    }
    ORBWEAVE_CHECK(false);
    return results.front();
  }
};

/// Runs every stage in order, the parts of a stage on `num_threads` threads.
inline absl::StatusOr<InProcessJob> RunInProcess(const JobSpec& job,
                                                 BlobAccess& blobs,
                                                 int num_threads = 1) {
  InProcessJob run;
  ORBWEAVE_ASSIGN_OR_RETURN(run.plan, FindJobPlan(job.kind));
  for (uint32_t s = 0; s < run.plan.stages.size(); ++s) {
    std::vector<Digest> listed;
    if (run.plan.stages[s].parts_listed_in) {
      ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes,
                                blobs.Get(job.inputs[*run.plan.stages[s].parts_listed_in]));
      ORBWEAVE_ASSIGN_OR_RETURN(listed, DecodeCollection(bytes));
    }
    ORBWEAVE_ASSIGN_OR_RETURN(const StagePlan stage,
                              PlanStage(run.plan, s, job, run.results, listed));
    for (const std::string& collection : stage.collections) {
      ORBWEAVE_RETURN_IF_ERROR(internal::StatusOf(blobs.Put(collection)));
    }
    std::vector<absl::StatusOr<TaskResult>> outcomes(stage.tasks.size(),
                                                     absl::UnknownError("not run"));
    ParallelFor(stage.tasks.size(), num_threads, [&](size_t part) {
      const TaskSpec& spec = stage.tasks[part];
      outcomes[part] = (*FindStage(spec.stage))(spec, blobs, {.seed = spec.Id().ToSeed()});
    });
    std::vector<TaskResult> results;
    for (absl::StatusOr<TaskResult>& outcome : outcomes) {
      if (!outcome.ok()) return Annotate(outcome.status(), run.plan.stages[s].stage);
      results.push_back(*std::move(outcome));
    }
    run.results.push_back(std::move(results));
  }
  return run;
}

}  // namespace orbweave::testing
