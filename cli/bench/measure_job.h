// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "bench/scaling/job_measurement.h"
#include "cli/arguments/fleet_argument.h"
#include "stages/pipeline_options.h"

namespace orbweave {

/// A corridor that is to be reconstructed and measured.
struct CorridorRun {
  std::string corridor{};  ///< folder, see WriteCorridor
  PipelineOptions options{};
  std::string folder{};  ///< of its state, where nothing has been done yet
  FleetArgument fleet{};
  uint32_t workers = 1;  ///< that have to be there before the job begins
  uint32_t slots = 1;    ///< of each
};

/// Reconstructs it from nothing, as `orbweave reconstruct` does. FailedPrecondition: a job ran in
/// that folder before; codes of RunLocalJob.
[[nodiscard]] absl::StatusOr<JobMeasurement> MeasureCorridorJob(const CorridorRun& run);

/// The last finished job of the output folder `output`, as its tasks are recorded. Codes of
/// OpenFinished and LastFinishedJob.
[[nodiscard]] absl::StatusOr<JobMeasurement> MeasureFinishedJob(const std::string& output);

}  // namespace orbweave
