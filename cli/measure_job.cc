// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/measure_job.h"

#include <ctime>

#include "cli/fetch_results.h"
#include "cli/finished_job.h"
#include "cli/run_local_job.h"
#include "core/report/build_job_report.h"
#include "core/report/job_results.h"
#include "stages/prepare_job.h"
#include "worker/peak_memory.h"

namespace orbweave {
namespace {

double ProcessCpuSeconds() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// What the coordinator keeps of a job, whenever it ran.
absl::StatusOr<JobMeasurement> Recorded(ClientApi& coordinator, const JobStatus& job) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<TaskOutcome> outcomes,
                            coordinator.GetOutcomes(job.id));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobResults results,
                            FetchResults(coordinator, job.spec, outcomes, nullptr));
  const JobReport report = BuildJobReport(results);
  JobMeasurement measurement{.label = job.spec.label,
                             .panoramas = report.images_total,
                             .registered = report.registered,
                             .residual_px_rms = report.residual_px_rms};
  ORBWEAVE_ASSIGN_OR_RETURN(measurement.tasks, coordinator.GetCosts(job.id));
  return measurement;
}

}  // namespace

absl::StatusOr<JobMeasurement> MeasureCorridorJob(const std::string& corridor,
                                                  const PipelineOptions& options,
                                                  uint32_t workers,
                                                  const std::string& folder) {
  JobMeasurement measurement;
  double cpu_start_s = 0.0;
  const auto prepare = [&](BlobDepot& coordinator, const StageContext& context) {
    absl::StatusOr<JobSpec> spec = PrepareDatabaseJob(
        coordinator, corridor + "/corridor.db", corridor + "/gnss.csv", "", options, context);
    RestartPeakMemory();
    cpu_start_s = ProcessCpuSeconds();
    return spec;
  };
  const auto conclude = [&](ClientApi& coordinator, const JobStatus& job) -> absl::Status {
    const double coordinator_cpu_s = ProcessCpuSeconds() - cpu_start_s;
    const uint64_t coordinator_peak_bytes = PeakMemoryBytes();
    ORBWEAVE_ASSIGN_OR_RETURN(measurement, Recorded(coordinator, job));
    ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<TaskTiming> timings,
                              coordinator.GetTimings(job.id));
    measurement.workers = workers;
    measurement.wall_s = job.elapsed_s;
    measurement.overhead = MeasureOverhead(timings, measurement.tasks);
    measurement.coordinator_cpu_s = coordinator_cpu_s;
    measurement.coordinator_peak_bytes = coordinator_peak_bytes;
    return absl::OkStatus();
  };
  const StopSignals signals;
  ORBWEAVE_RETURN_IF_ERROR(RunLocalJob(
      {.output = folder, .fleet = {.workers = workers}, .prepare = prepare, .conclude = conclude},
      signals));
  return measurement;
}

absl::StatusOr<JobMeasurement> MeasureFinishedJob(const std::string& output) {
  const SteadyClock clock;
  ORBWEAVE_ASSIGN_OR_RETURN(const auto coordinator, OpenFinished(output, clock));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus job, LastFinishedJob(*coordinator, output));
  return Recorded(*coordinator, job);
}

}  // namespace orbweave
