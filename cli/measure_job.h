// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "bench/scaling/job_measurement.h"
#include "stages/pipeline_options.h"

namespace orbweave {

/// Reconstructs the corridor in `corridor` (see WriteCorridor) from nothing, as
/// `orbweave reconstruct` does, with state in `folder`. Codes of RunLocalJob.
[[nodiscard]] absl::StatusOr<JobMeasurement> MeasureCorridorJob(const std::string& corridor,
                                                                const PipelineOptions& options,
                                                                uint32_t workers,
                                                                const std::string& folder);

/// The last finished job of the output folder `output`, as its tasks are recorded. Codes of
/// OpenFinished and LastFinishedJob.
[[nodiscard]] absl::StatusOr<JobMeasurement> MeasureFinishedJob(const std::string& output);

}  // namespace orbweave
