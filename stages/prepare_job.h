// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/base/stage_context.h"
#include "core/io/images/scan_image_folder.h"
#include "core/pipeline/blob_depot.h"
#include "core/pipeline/job_api.h"
#include "stages/pipeline_options.h"

namespace orbweave {

/// Makes everything a job on a folder of panoramas reads known to the depot: files are linked
/// where the depot can read them itself and uploaded where it cannot. The job is not
/// submitted. `cluster_table`: path of clusters by hand (ReadClusterTable), or empty.
/// InvalidArgument where options cannot work together (CheckOptionsTogether).
[[nodiscard]] absl::StatusOr<JobSpec> PrepareImageJob(BlobDepot& depot,
                                                      const ScanRequest& request,
                                                      const std::string& cluster_table,
                                                      const PipelineOptions& options,
                                                      const StageContext& context);

/// The same for images and masks at any places, those of the request.
[[nodiscard]] absl::StatusOr<JobSpec> PrepareImageJob(BlobDepot& depot,
                                                      const ImagePlaces& places,
                                                      const ScanRequest& request,
                                                      const std::string& cluster_table,
                                                      const PipelineOptions& options,
                                                      const StageContext& context);

/// The same for keypoints and matches from a COLMAP database, without pairs that GNSS says are far
/// apart (SetAsideFarPairs). `gnss_table` and `cluster_table`: paths, or empty.
[[nodiscard]] absl::StatusOr<JobSpec> PrepareDatabaseJob(BlobDepot& depot,
                                                         const std::string& database,
                                                         const std::string& gnss_table,
                                                         const std::string& cluster_table,
                                                         const PipelineOptions& options,
                                                         const StageContext& context);

}  // namespace orbweave
