// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cli/arguments/fleet_argument.h"
#include "cli/arguments/option_arguments.h"
#include "cli/process/stop_signals.h"
#include "core/base/status.h"
#include "core/io/images/scan_image_folder.h"
#include "core/pipeline/coordinator_api.h"

namespace orbweave {

/// A job on the poses and points that the finished sparse job `sparse` of a coordinator left. Codes
/// of CheckDenseOptions.
[[nodiscard]] absl::StatusOr<JobSpec> DenseJobOf(ClientApi& coordinator,
                                                 const JobStatus& sparse,
                                                 const PipelineOptions& options);

/// Computes the dense cloud of the finished model in the folder `output`, with workers on this
/// machine, into output/dense; shows progress and prints a summary. Run again it goes on where it
/// was. FailedPrecondition: there is no finished model. Codes of RunLocalJob.
[[nodiscard]] absl::Status RunDenseJob(const std::string& output,
                                       const FleetArgument& fleet,
                                       const PipelineOptions& options,
                                       const StopSignals& signals);

/// The same for the poses of a COLMAP model and a folder of panoramas, into `output`.
[[nodiscard]] absl::Status RunDenseJobOnColmap(const std::string& colmap_model,
                                               const ScanRequest& images,
                                               const std::string& output,
                                               const FleetArgument& fleet,
                                               const PipelineOptions& options,
                                               const StopSignals& signals);

}  // namespace orbweave
