// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/pipeline/blob_access.h"
#include "core/pipeline/task.h"

/// The stages from submodels to their alignment, as tasks. Inputs and outputs:
/// core/pipeline/job_plan.cc.

namespace orbweave {

/// DividedViewGraph, rims of all clusters (not opened) -> recipes: one per cluster, a collection of
/// its rims and those of later clusters that it has a seam with.
absl::StatusOr<TaskResult> RunListSeams(const TaskSpec& spec,
                                        BlobAccess& blobs,
                                        const StageContext& context);
/// Such a collection -> SeamsOfCluster.
absl::StatusOr<TaskResult> RunFitSeams(const TaskSpec& spec,
                                       BlobAccess& blobs,
                                       const StageContext& context);
/// SeamsOfCluster of all clusters -> Alignment.
absl::StatusOr<TaskResult> RunAlignSubmodels(const TaskSpec& spec,
                                             BlobAccess& blobs,
                                             const StageContext& context);
/// DividedViewGraph, Alignment, PartitionReview of the round before -> PartitionReview; a recipe
/// when anybody asks for more overlap.
absl::StatusOr<TaskResult> RunReviewSeams(const TaskSpec& spec,
                                          BlobAccess& blobs,
                                          const StageContext& context);

}  // namespace orbweave
