// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/engine_study.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "bench/scaling/fleet_model_of.h"
#include "bench/scaling/simulate_schedule.h"
#include "core/base/quantile.h"
#include "core/base/status.h"

namespace orbweave {
namespace {

/// The first run on the fewest nodes of the same kind.
const StudyRun& FewestLike(const StudyRun& run, const std::vector<StudyRun>& runs) {
  const StudyRun* fewest = &run;
  for (const StudyRun& other : runs) {
    if (other.kind == run.kind &&
        std::tie(other.job.workers, other.repeat) < std::tie(fewest->job.workers, fewest->repeat))
      fewest = &other;
  }
  return *fewest;
}

double Simulated(const StudyRun& run, const StudyRun& fewest) {
  const JobMeasurement& measured = fewest.job.panoramas == run.job.panoramas ? fewest.job : run.job;
  return SimulateSchedule(StageLoadsOf(measured.tasks), run.job.workers, FleetModelOf(fewest.job))
      .makespan_s;
}

StudyPoint PointOf(const StudyRun& run, const std::vector<StudyRun>& runs) {
  const JobMeasurement& job = run.job;
  ORBWEAVE_CHECK(job.workers > 0 && job.wall_s > 0.0);
  StudyPoint point{.kind = run.kind,
                   .nodes = job.workers,
                   .repeat = run.repeat,
                   .panoramas = job.panoramas,
                   .wall_s = job.wall_s,
                   .coordinator_cpu_s = job.coordinator_cpu_s,
                   .links = job.links};
  for (const MeasuredTask& task : job.tasks) {
    point.cpu_s += task.cost.cpu_s;
    point.read_bytes += task.cost.bytes_in;
    point.written_bytes += task.cost.bytes_out;
  }
  point.coordinator_ms_per_task =
      1e3 * job.coordinator_cpu_s / static_cast<double>(std::max<size_t>(1, job.tasks.size()));
  point.simulated_s = Simulated(run, FewestLike(run, runs));
  point.simulation_error = point.simulated_s / job.wall_s - 1.0;
  point.shares = ShareTime(
      job.timings, job.tasks, job.workers * job.slots, job.processors_per_slot, job.wall_s);
  return point;
}

void CompareToFewest(EngineStudy& study) {
  for (StudyPoint& point : study.points) {
    const uint32_t fewest = NodesOf(study, point.kind).front();
    const double base_s = MedianWall(study, point.kind, fewest);
    const double nodes =
        point.kind == ScalingKind::kStrong ? static_cast<double>(point.nodes) / fewest : 1.0;
    point.efficiency = base_s / (nodes * point.wall_s);
  }
}

}  // namespace

double MedianWall(const EngineStudy& study, ScalingKind kind, uint32_t nodes) {
  std::vector<double> walls_s;
  for (const StudyPoint& point : study.points) {
    if (point.kind == kind && point.nodes == nodes) walls_s.push_back(point.wall_s);
  }
  return walls_s.empty() ? 0.0 : UpperMedian(std::move(walls_s));
}

std::vector<uint32_t> NodesOf(const EngineStudy& study, ScalingKind kind) {
  std::set<uint32_t> nodes;
  for (const StudyPoint& point : study.points) {
    if (point.kind == kind) nodes.insert(point.nodes);
  }
  return {nodes.begin(), nodes.end()};
}

EngineStudy BuildEngineStudy(const std::vector<StudyRun>& runs, const EngineFacts& facts) {
  ORBWEAVE_CHECK(!runs.empty());
  const JobMeasurement& first = runs.front().job;
  EngineStudy study{.facts = facts,
                    .slots = first.slots,
                    .processors_per_slot = first.processors_per_slot,
                    .link_gbit_per_s = first.link_gbit_per_s};
  for (const StudyRun& run : runs) study.points.push_back(PointOf(run, runs));
  std::ranges::sort(study.points, {}, [](const StudyPoint& point) {
    return std::tuple(point.kind, point.nodes, point.repeat);
  });
  CompareToFewest(study);
  for (const StudyPoint& point : study.points) {
    const bool is_crowded =
        facts.machine_processors > 0 &&
        point.nodes * study.slots * study.processors_per_slot > facts.machine_processors;
    if (is_crowded && (study.crowded_from == 0 || point.nodes < study.crowded_from))
      study.crowded_from = point.nodes;
  }
  return study;
}

}  // namespace orbweave
