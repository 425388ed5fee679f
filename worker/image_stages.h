// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/pipeline/blob_access.h"
#include "core/pipeline/task.h"

/// The stages from files to verified pairs, as tasks. Inputs and outputs:
/// core/pipeline/job_plan.cc.

namespace orbweave {

/// sources -> manifest; recipes: one per image.
absl::StatusOr<TaskResult> RunIngestImages(const TaskSpec& spec,
                                           BlobAccess& blobs,
                                           const StageContext& context);
/// ExtractRecipe -> Features, PlaceSample.
absl::StatusOr<TaskResult> RunExtractFeatures(const TaskSpec& spec,
                                              BlobAccess& blobs,
                                              const StageContext& context);
/// manifest, extracted -> nothing; recipes: runs of pairs.
absl::StatusOr<TaskResult> RunSelectImagePairs(const TaskSpec& spec,
                                               BlobAccess& blobs,
                                               const StageContext& context);
/// MatchRecipe -> TwoViewGeometries. Also verifies matches given in the recipe.
absl::StatusOr<TaskResult> RunMatchImages(const TaskSpec& spec,
                                          BlobAccess& blobs,
                                          const StageContext& context);

}  // namespace orbweave
