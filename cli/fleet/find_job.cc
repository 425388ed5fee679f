// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/fleet/find_job.h"

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace orbweave {

absl::StatusOr<JobStatus> FindJob(JobApi& coordinator, const std::string& prefix) {
  if (const absl::StatusOr<Digest> whole = Digest::FromHex(prefix); whole.ok())
    return coordinator.GetJob(*whole);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<JobStatus> jobs, coordinator.ListJobs());
  const JobStatus* found = nullptr;
  for (const JobStatus& job : jobs) {
    if (!absl::StartsWith(job.id.ToHex(), prefix)) continue;
    if (found != nullptr) {
      return absl::InvalidArgumentError(
          absl::StrCat("several jobs begin with ", prefix, ": give more digits"));
    }
    found = &job;
  }
  if (found == nullptr) return absl::NotFoundError(absl::StrCat("there is no job ", prefix));
  return *found;
}

}  // namespace orbweave
