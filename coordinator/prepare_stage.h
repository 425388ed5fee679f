// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "coordinator/journal/journal.h"
#include "coordinator/kept_blobs.h"
#include "core/pipeline/plan_stage.h"

namespace orbweave {

/// A stage ready to begin: its tasks, and the results that earlier runs left for them.
struct PreparedStage {
  std::vector<TaskSpec> tasks{};
  std::vector<std::optional<TaskResult>> found{};
};

/// A job as far as it has come, copied out of its machine.
struct JobSnapshot {
  JobSpec spec{};
  JobPlan plan{};
  uint32_t stage = 0;  ///< to prepare
  std::vector<std::vector<TaskResult>> results{};
  bool verify =
      true;  ///< read every blob of a found result; otherwise look only whether it is there
};

/// The tasks of stage `snapshot.stage`. Errors: those of PlanStage and of the store, from which the
/// list of its parts is read where the job brings one.
[[nodiscard]] absl::StatusOr<StagePlan> PlanSnapshot(const JobSnapshot& snapshot,
                                                     BlobAccess& blobs);

/// Plans stage `snapshot.stage`, stores the collections it reads, and looks up each task in the
/// journal. A result counts as found when all its blobs are there (and, with `verify`, are right).
/// Errors: those of PlanStage and of the store.
[[nodiscard]] absl::StatusOr<PreparedStage> PrepareStage(const JobSnapshot& snapshot,
                                                         KeptBlobs& blobs,
                                                         Journal& journal);

}  // namespace orbweave
