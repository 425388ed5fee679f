// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "bench/scaling/build_scaling_report.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include "bench/scaling/fit_growth.h"
#include "bench/scaling/fleet_model_of.h"
#include "bench/scaling/grow_job.h"
#include "bench/scaling/stage_totals.h"
#include "core/base/status.h"
#include "core/pipeline/build_version.h"

namespace orbweave {
namespace {

const JobMeasurement& LargestOnFewest(const std::vector<JobMeasurement>& jobs) {
  return *std::max_element(jobs.begin(), jobs.end(), [](const auto& a, const auto& b) {
    return std::tie(a.panoramas, b.workers) < std::tie(b.panoramas, a.workers);
  });
}

FleetModel ModelOf(const JobMeasurement& job, const ScalingQuestion& question) {
  FleetModel model = FleetModelOf(job);
  model.worker_gbit_per_s = question.worker_gbit_per_s;
  model.coordinator_gbit_per_s = question.coordinator_gbit_per_s;
  return model;
}

using TotalsValue = std::function<double(const StageTotals&)>;

/// Exponents of a total over panoramas, by stage, from the jobs on as few workers as `base`.
std::map<std::string, double> GrowthOf(const std::vector<JobMeasurement>& jobs,
                                       const JobMeasurement& base,
                                       const TotalsValue& value) {
  std::map<std::string, std::vector<std::pair<double, double>>> points;
  for (const JobMeasurement& job : jobs) {
    if (job.workers != base.workers) continue;
    for (const StageTotals& total : SumByStage(job.tasks))
      points[total.stage].push_back({job.panoramas, value(total)});
  }
  std::map<std::string, double> exponents;
  for (const auto& [stage, of_stage] : points) {
    if (const std::optional<PowerLaw> law = FitGrowth(of_stage)) exponents[stage] = law->exponent;
  }
  return exponents;
}

double CpuOf(const StageTotals& total) { return total.cpu_s; }
double BytesOf(const StageTotals& total) {
  return static_cast<double>(total.bytes_in) + static_cast<double>(total.bytes_out);
}

std::vector<ScalingStage> StagesOf(const std::vector<JobMeasurement>& jobs,
                                   const JobMeasurement& base) {
  const std::map<std::string, double> growth = GrowthOf(jobs, base, CpuOf);
  const double panoramas = std::max(1U, base.panoramas);
  std::vector<ScalingStage> stages;
  for (const StageTotals& total : SumByStage(base.tasks)) {
    ScalingStage& stage = stages.emplace_back();
    stage.name = total.stage;
    stage.runs = total.runs;
    stage.tasks = total.tasks;
    stage.cpu_s = total.cpu_s;
    stage.serial_share = total.cpu_s > 0.0 ? total.longest_cpu_s / total.cpu_s : 1.0;
    if (growth.contains(total.stage)) stage.growth_exponent = growth.at(total.stage);
    stage.bytes_in_per_panorama = static_cast<double>(total.bytes_in) / panoramas;
    stage.bytes_out_per_panorama = static_cast<double>(total.bytes_out) / panoramas;
    stage.peak_memory_bytes = total.peak_memory_bytes;
  }
  return stages;
}

/// A schedule's time by stage, in the order of `stages`.
std::vector<double> ByStage(const std::vector<StageLoad>& runs,
                            const Schedule& schedule,
                            const std::vector<ScalingStage>& stages) {
  std::vector<double> stage_s(stages.size(), 0.0);
  for (size_t r = 0; r < runs.size(); ++r) {
    for (size_t s = 0; s < stages.size(); ++s) {
      if (stages[s].name == runs[r].stage) stage_s[s] += schedule.run_s[r];
    }
  }
  return stage_s;
}

std::set<uint32_t> WorkerNumbers(const std::vector<JobMeasurement>& jobs) {
  std::set<uint32_t> numbers = {1};
  for (const uint32_t decade : {1U, 10U, 100U}) {
    for (const uint32_t tenths : {15U, 20U, 30U, 50U, 70U, 100U})
      numbers.insert(std::max(1U, decade * tenths / 10));
  }
  for (const JobMeasurement& job : jobs) {
    if (job.workers > 0) numbers.insert(job.workers);
  }
  return numbers;
}

ScalingPrediction Predict(const std::vector<StageLoad>& runs,
                          const std::vector<ScalingStage>& stages,
                          const std::set<uint32_t>& workers,
                          const FleetModel& model) {
  ScalingPrediction prediction;
  const Schedule critical = CriticalPath(runs, model);
  prediction.critical_path_s = critical.makespan_s;
  prediction.critical_stage_s = ByStage(runs, critical, stages);
  const double alone_s = SimulateSchedule(runs, 1, model).makespan_s;
  for (const uint32_t count : workers) {
    const Schedule schedule = SimulateSchedule(runs, count, model);
    const double efficiency =
        schedule.makespan_s > 0.0 ? alone_s / (count * schedule.makespan_s) : 1.0;
    prediction.points.push_back(
        {count, schedule.makespan_s, efficiency, ByStage(runs, schedule, stages)});
  }
  return prediction;
}

/// As many times the measured job as there are workers.
std::vector<ScalingWeakPoint> WeakScaling(const std::vector<StageLoad>& runs,
                                          const std::map<std::string, StageGrowth>& growth,
                                          uint32_t panoramas,
                                          const FleetModel& model) {
  const double alone_s = SimulateSchedule(runs, 1, model).makespan_s;
  std::vector<ScalingWeakPoint> points;
  for (const uint32_t workers : {1U, 2U, 5U, 10U, 20U, 50U, 100U}) {
    const double wall_s =
        SimulateSchedule(GrowJob(runs, workers, growth), workers, model).makespan_s;
    points.push_back({.workers = workers,
                      .panoramas = uint64_t{workers} * panoramas,
                      .wall_s = wall_s,
                      .efficiency = wall_s > 0.0 ? alone_s / wall_s : 1.0});
  }
  return points;
}

/// Of each run of a stage: loops run as often as they did. Linear growth at least: what a stage
/// does once hides in small jobs behind what it always does.
std::map<std::string, StageGrowth> CarefulGrowth(const std::vector<JobMeasurement>& jobs,
                                                 const JobMeasurement& base) {
  std::map<std::string, StageGrowth> growth;
  const auto per_run = [](const TotalsValue& value) {
    return [value](const StageTotals& total) { return value(total) / total.runs; };
  };
  for (const auto& [stage, exponent] : GrowthOf(jobs, base, per_run(CpuOf)))
    growth[stage].compute = std::max(1.0, exponent);
  for (const auto& [stage, exponent] : GrowthOf(jobs, base, per_run(BytesOf)))
    growth[stage].bytes = std::max(1.0, exponent);
  return growth;
}

std::vector<ScalingRun> RunsOf(const std::vector<JobMeasurement>& jobs, const FleetModel& model) {
  std::vector<ScalingRun> runs;
  for (const JobMeasurement& job : jobs) {
    if (job.workers == 0) continue;
    ScalingRun& run = runs.emplace_back();
    run.panoramas = job.panoramas;
    run.registered = job.registered;
    run.workers = job.workers;
    run.wall_s = job.wall_s;
    for (const MeasuredTask& task : job.tasks) run.cpu_s += task.cost.cpu_s;
    run.simulated_s = SimulateSchedule(StageLoadsOf(job.tasks), job.workers, model).makespan_s;
    run.residual_px_rms = job.residual_px_rms;
    run.coordinator_peak_bytes = job.coordinator_peak_bytes;
  }
  return runs;
}

/// Against the fewest workers on the same panoramas.
void CompareRuns(std::vector<ScalingRun>& runs) {
  for (ScalingRun& run : runs) {
    const ScalingRun* fewest = &run;
    size_t same_size = 0;
    for (const ScalingRun& other : runs) {
      if (other.panoramas != run.panoramas) continue;
      ++same_size;
      if (other.workers < fewest->workers) fewest = &other;
    }
    if (same_size > 1)
      run.efficiency = fewest->wall_s * fewest->workers / (run.wall_s * run.workers);
  }
}

}  // namespace

ScalingReport BuildScalingReport(const std::vector<JobMeasurement>& jobs,
                                 const ScalingQuestion& question) {
  ORBWEAVE_CHECK(!jobs.empty());
  const JobMeasurement& base = LargestOnFewest(jobs);
  const FleetModel model = ModelOf(base, question);
  ScalingReport report{.version = std::string(BuildVersion()),
                       .title = base.label,
                       .panoramas = base.panoramas,
                       .runs = RunsOf(jobs, FleetModelOf(base)),
                       .stages = StagesOf(jobs, base),
                       .assumptions = {.worker_gbit_per_s = model.worker_gbit_per_s,
                                       .coordinator_gbit_per_s = model.coordinator_gbit_per_s,
                                       .overhead_measured = base.workers > 0,
                                       .task_overhead_s = model.task_overhead_s,
                                       .stage_overhead_s = model.stage_overhead_s,
                                       .coordinator_s_per_task = model.coordinator_s_per_task}};
  CompareRuns(report.runs);
  const std::set<uint32_t> workers = WorkerNumbers(jobs);
  const std::vector<StageLoad> runs = StageLoadsOf(base.tasks);
  report.predictions.push_back(Predict(runs, report.stages, workers, model));
  report.predictions.back().panoramas = base.panoramas;
  const std::map<std::string, StageGrowth> growth = CarefulGrowth(jobs, base);
  if (growth.empty()) return report;
  report.weak = WeakScaling(runs, growth, base.panoramas, model);
  for (const uint32_t panoramas : question.predict) {
    const double factor = static_cast<double>(panoramas) / std::max(1U, base.panoramas);
    report.predictions.push_back(
        Predict(GrowJob(runs, factor, growth), report.stages, workers, model));
    report.predictions.back().panoramas = panoramas;
    report.predictions.back().extrapolated = true;
  }
  return report;
}

}  // namespace orbweave
