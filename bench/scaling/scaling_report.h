// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/scaling/engine_study.h"

namespace orbweave {

/// A job that was really run.
struct ScalingRun {
  uint32_t panoramas = 0;
  uint32_t registered = 0;
  uint32_t workers = 1;
  double wall_s = 0.0;
  double cpu_s = 0.0;  ///< of all tasks
  double efficiency =
      0.0;  ///< against the fewest workers on the same panoramas; 0: none to compare
  double simulated_s = 0.0;  ///< what the simulation says of this very job
  double residual_px_rms = 0.0;
  uint64_t coordinator_peak_bytes = 0;
};

/// A stage of the largest job that was run.
struct ScalingStage {
  std::string name{};
  uint32_t runs = 0;
  uint32_t tasks = 0;
  double cpu_s = 0.0;
  double serial_share = 0.0;  ///< CPU time of the longest task of each run over that of all
  std::optional<double> growth_exponent{};  ///< of CPU time over panoramas
  double bytes_in_per_panorama = 0.0;
  double bytes_out_per_panorama = 0.0;
  uint64_t peak_memory_bytes = 0;  ///< of a worker's process
};

/// Simulated.
struct ScalingPoint {
  uint32_t workers = 1;
  double wall_s = 0.0;
  double efficiency = 1.0;        ///< time of one worker over workers times this time
  std::vector<double> stage_s{};  ///< of the wall time, by stage
};

/// What a job of this size would take, by the number of workers: simulated.
struct ScalingPrediction {
  uint32_t panoramas = 0;
  bool extrapolated = false;  ///< no job of this size was measured
  double critical_path_s = 0.0;
  std::vector<double> critical_stage_s{};  ///< of the critical path, by stage
  std::vector<ScalingPoint> points{};      ///< by workers
};

/// A job that grows with the number of workers: simulated.
struct ScalingWeakPoint {
  uint32_t workers = 1;
  uint64_t panoramas = 0;
  double wall_s = 0.0;
  double efficiency = 1.0;  ///< time of one worker on the measured job over this time
};

/// What the simulation takes for granted.
struct ScalingAssumptions {
  double worker_gbit_per_s = 0.0;
  double coordinator_gbit_per_s = 0.0;
  bool overhead_measured = false;
  double task_overhead_s = 0.0;
  double stage_overhead_s = 0.0;
  double coordinator_s_per_task = 0.0;
};

struct ScalingReport {
  std::string version{};
  std::string title{};
  uint32_t processors = 0;    ///< of the machine that ran the jobs
  double load_average = 0.0;  ///< of that machine when the command began
  uint32_t panoramas = 0;     ///< of the largest job
  std::vector<ScalingRun> runs{};
  std::vector<ScalingStage> stages{};
  std::vector<ScalingPrediction> predictions{};  ///< the measured job, then those extrapolated
  std::vector<ScalingWeakPoint> weak{};          ///< by workers; empty where growth is not known
  ScalingAssumptions assumptions{};
  std::optional<EngineStudy> study{};  ///< where an engine ran jobs on more and more nodes
};

}  // namespace orbweave
