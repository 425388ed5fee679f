// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "bench/scaling/job_measurement.h"
#include "bench/scaling/scaling_report.h"

namespace orbweave {

struct ScalingQuestion {
  double worker_gbit_per_s = 1.0;
  double coordinator_gbit_per_s = 10.0;
  std::vector<uint32_t> predict{};  ///< panoramas of jobs that were not run
};

/// The report on measured jobs: stages of the largest job on its fewest workers, with the growth of
/// their CPU time over the jobs on as few workers; that job simulated on 1 to 1,000 workers; and
/// jobs of other sizes extrapolated from it, where jobs of two sizes at least tell the growth.
/// CHECK: there is a job.
[[nodiscard]] ScalingReport BuildScalingReport(const std::vector<JobMeasurement>& jobs,
                                               const ScalingQuestion& question);

}  // namespace orbweave
