// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/pipeline/blob_access.h"
#include "core/pipeline/task.h"

/// The stages from verified pairs to submodels, as tasks. Inputs and outputs:
/// core/pipeline/job_plan.cc.

namespace orbweave {

/// manifest, extracted, verified pairs, clusters by hand, DividedViewGraph and PartitionReview of
/// the round before -> DividedViewGraph; recipes: one per cluster.
absl::StatusOr<TaskResult> RunPartitionViewGraph(const TaskSpec& spec,
                                                 BlobAccess& blobs,
                                                 const StageContext& context);
/// ClusterRecipe -> ClusterResult, and the same with rims alone.
absl::StatusOr<TaskResult> RunReconstructCluster(const TaskSpec& spec,
                                                 BlobAccess& blobs,
                                                 const StageContext& context);

}  // namespace orbweave
