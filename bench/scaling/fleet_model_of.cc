// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/fleet_model_of.h"

#include <algorithm>

namespace orbweave {
namespace {

/// Of a coordinator and workers on one machine; used where a job's own are not known.
constexpr FleetModel kUsualOverhead{
    .task_overhead_s = 0.005, .stage_overhead_s = 0.02, .coordinator_s_per_task = 0.002};
constexpr double kNoLink = 1e9;

}  // namespace

FleetModel FleetModelOf(const JobMeasurement& job) {
  FleetModel model = kUsualOverhead;
  if (job.workers > 0) {
    model.task_overhead_s = job.overhead.task_s;
    model.stage_overhead_s = job.overhead.stage_s;
    model.coordinator_s_per_task =
        job.coordinator_cpu_s / static_cast<double>(std::max<size_t>(job.tasks.size(), 1));
  }
  model.worker_gbit_per_s = job.link_gbit_per_s > 0.0 ? job.link_gbit_per_s : kNoLink;
  model.coordinator_gbit_per_s = kNoLink;
  model.slots = job.slots;
  model.processors_per_slot = job.processors_per_slot;
  return model;
}

}  // namespace orbweave
