// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unordered_set>

#include "coordinator/journal/journal.h"
#include "core/pipeline/blob_access.h"
#include "core/pipeline/job_plan.h"

namespace orbweave {

/// What jobs need.
struct JobNeeds {
  std::unordered_set<Digest> blobs{};
  std::unordered_set<Digest> tasks{};  ///< whose results they have
  /// Of the blobs: those that name others which no task has made, as images that were sent.
  std::unordered_set<Digest> lists{};
};

/// Adds what a job needs to go on, or to show its results: its inputs, and of every task that is
/// known so far what it reads and left. The job's plan is gone through as a coordinator does that
/// was started anew, with the results in the journal, to the first stage that is not done. Errors:
/// those of PlanSnapshot and of the journal; `needs` is then not complete.
[[nodiscard]] absl::Status AddNeedsOf(
    const JobSpec& spec, const JobPlan& plan, BlobAccess& blobs, Journal& journal, JobNeeds& needs);

/// Adds those of `stored` that the lists of `needs` name: whose 32 bytes stand in one of them,
/// wherever. A list that is gone or damaged names none; other errors of the store are returned.
[[nodiscard]] absl::Status AddNamedBlobs(const std::unordered_set<Digest>& stored,
                                         BlobAccess& blobs,
                                         JobNeeds& needs);

}  // namespace orbweave
