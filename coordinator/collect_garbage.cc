// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/collect_garbage.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "absl/strings/str_cat.h"
#include "coordinator/job_needs.h"

namespace orbweave {
namespace {

absl::StatusOr<JobNeeds> NeedsOfAllJobs(const PlanLookup& find_plan,
                                        KeptBlobs& blobs,
                                        Journal& journal) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<JobEntry> jobs, journal.LoadJobs());
  JobNeeds needs;
  for (const JobEntry& job : jobs) {
    const absl::StatusOr<JobPlan> plan = find_plan(job.spec.kind);
    const absl::Status added =
        plan.ok() ? AddNeedsOf(job.spec, *plan, blobs, journal, needs) : plan.status();
    if (added.ok()) continue;
    if (absl::IsUnavailable(added)) return added;
    return absl::FailedPreconditionError(absl::StrCat("what job ",
                                                      job.spec.Id().ToShortHex(),
                                                      " needs cannot be told (",
                                                      added.message(),
                                                      "): submit it again, or forget it"));
  }
  return needs;
}

bool IsComplete(const TaskResult& result, KeptBlobs& blobs) {
  const auto is_there = [&blobs](const Digest& blob) { return blobs.Has(blob); };
  return std::ranges::all_of(result.outputs, is_there) &&
         std::ranges::all_of(result.recipes, is_there);
}

}  // namespace

absl::StatusOr<GarbageReport> CollectGarbage(const GarbageOptions& options,
                                             const PlanLookup& find_plan,
                                             KeptBlobs& blobs,
                                             Journal& journal) {
  if (!std::isfinite(options.unused_s) || options.unused_s < 0.0)
    return absl::InvalidArgumentError("blobs are unused for a number of seconds");
  // In this order: a blob that is put, or a job that is submitted, after its step is not looked at,
  // or was used just now.
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<StoredBlob> stored, blobs.List());
  ORBWEAVE_ASSIGN_OR_RETURN(JobNeeds needs, NeedsOfAllJobs(find_plan, blobs, journal));
  std::unordered_set<Digest> names;
  for (const StoredBlob& blob : stored) names.insert(blob.digest);
  ORBWEAVE_RETURN_IF_ERROR(AddNamedBlobs(names, blobs, needs));
  GarbageReport report;
  for (const StoredBlob& blob : stored) {
    if (needs.blobs.contains(blob.digest)) {
      ++report.needed_blobs;
      report.needed_bytes += blob.size_bytes;
      continue;
    }
    bool is_removed = blobs.IsUnused(blob.digest, options.unused_s);
    if (!options.dry_run) {
      ORBWEAVE_ASSIGN_OR_RETURN(is_removed, blobs.RemoveUnused(blob.digest, options.unused_s));
    }
    ++(is_removed ? report.removed_blobs : report.recent_blobs);
    (is_removed ? report.removed_bytes : report.recent_bytes) += blob.size_bytes;
  }
  if (options.dry_run) return report;
  ORBWEAVE_ASSIGN_OR_RETURN(
      report.forgotten_results,
      journal.ForgetResults([&](const Digest& task, const TaskResult& result) {
        return !needs.tasks.contains(task) && !IsComplete(result, blobs);
      }));
  return report;
}

}  // namespace orbweave
