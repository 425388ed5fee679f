// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/scaling/stage_totals.h"
#include "core/base/digest.h"
#include "core/base/status.h"
#include "stages/pipeline_options.h"

namespace orbweave {

/// What a dense job on a street took and left.
struct DenseMeasurement {
  uint32_t workers = 0;
  double wall_s = 0.0;
  size_t panoramas = 0;
  double megapixels = 0.0;  ///< of these panoramas together
  uint64_t points = 0;
  Digest cloud{};  ///< of cloud.las
  std::vector<StageTotals> stages{};
};

/// Computes the cloud of the street in `street` (see WriteStreet: images, masks, truth.csv) with
/// its true poses and without any points, from nothing, with state and cloud in `folder`. Codes of
/// ReadFile, ParseReferencePoses, PrepareDenseJob and RunLocalJob.
[[nodiscard]] absl::StatusOr<DenseMeasurement> MeasureDenseJob(const std::string& street,
                                                               const PipelineOptions& options,
                                                               uint32_t workers,
                                                               const std::string& folder);

}  // namespace orbweave
