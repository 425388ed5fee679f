// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/scaling/measure_overhead.h"

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

}  // namespace orbweave
