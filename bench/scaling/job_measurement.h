// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/scaling/measure_overhead.h"

namespace orbweave {

/// What went over a node's link while a job ran, as the node's network counted it: with the heads
/// of packets and everything that is no blob.
struct LinkTraffic {
  std::string node{};
  uint64_t in_bytes = 0;
  uint64_t out_bytes = 0;
};

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

  uint32_t slots = 1;                 ///< of each worker
  double processors_per_slot = 1.0;   ///< less where nodes are given a share of one
  double link_gbit_per_s = 0.0;       ///< of each worker; 0: no network, or nobody knows
  std::vector<TaskTiming> timings{};  ///< of all attempts; empty: not known
  std::vector<LinkTraffic> links{};   ///< empty: not known
};

}  // namespace orbweave
