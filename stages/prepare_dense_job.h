// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/base/stage_context.h"
#include "core/io/colmap/colmap_model.h"
#include "core/io/images/scan_image_folder.h"
#include "core/pipeline/blob_depot.h"
#include "core/pipeline/job_api.h"
#include "stages/pipeline_options.h"

namespace orbweave {

/// Makes everything known that a dense job on the poses of a model (its points are not needed)
/// and a folder of its panoramas reads. The job is not submitted. Images of the model that the
/// folder lacks count as excluded. Codes of CheckDenseOptions, ScanImagePlaces and ModelFromColmap.
[[nodiscard]] absl::StatusOr<JobSpec> PrepareDenseJob(BlobDepot& depot,
                                                      const ColmapModel& model,
                                                      const ScanRequest& request,
                                                      const PipelineOptions& options,
                                                      const StageContext& context);

}  // namespace orbweave
