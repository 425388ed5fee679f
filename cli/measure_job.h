// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/pipeline/measure_overhead.h"
#include "stages/pipeline_options.h"

namespace orbweave {

/// What a job was and took.
struct JobMeasurement {
  std::string label{};
  uint32_t panoramas = 0;
  uint32_t registered = 0;
  double residual_px_rms = 0.0;
  std::vector<MeasuredTask> tasks{};
  uint32_t workers = 0;  ///< 0: it ran some time ago, and what follows is not known
  double wall_s = 0.0;
  ScheduleOverhead overhead{};
  double coordinator_cpu_s = 0.0;
  uint64_t coordinator_peak_bytes = 0;
};

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
