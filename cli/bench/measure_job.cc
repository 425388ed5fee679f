// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/bench/measure_job.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>

#include "absl/strings/str_cat.h"
#include "cli/jobs/run_local_job.h"
#include "cli/results/fetch_results.h"
#include "cli/results/finished_job.h"
#include "core/base/sleep.h"
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

/// So that time is that of the job, and not of whoever starts workers.
absl::Status AwaitWorkers(JobApi& coordinator, uint32_t count, const std::stop_token& stop) {
  constexpr double kLook_s = 0.1;
  constexpr double kSay_s = 60.0;
  double until_said_s = kSay_s;
  while (!stop.stop_requested()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<WorkerStatus> workers, coordinator.ListWorkers());
    const auto here = std::ranges::count_if(workers, &WorkerStatus::alive);
    if (here >= count) return absl::OkStatus();
    if ((until_said_s -= kLook_s) <= 0.0) {
      std::fprintf(stderr, "%d of %u workers are there\n", static_cast<int>(here), count);
      until_said_s = kSay_s;
    }
    SleepUnlessStopped(kLook_s, stop);
  }
  return absl::CancelledError("interrupted");
}

absl::Status CheckNothingRanIn(const std::string& folder) {
  std::error_code error;
  if (!std::filesystem::exists(BlobFolderOf(folder + "/.orbweave"), error)) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrCat(
      folder, ": a job ran here before; a measurement begins anew, remove the folder"));
}

}  // namespace

absl::StatusOr<JobMeasurement> MeasureCorridorJob(const CorridorRun& run) {
  ORBWEAVE_RETURN_IF_ERROR(CheckNothingRanIn(run.folder));
  JobMeasurement measurement;
  double cpu_start_s = 0.0;
  const auto prepare = [&](ClientApi& coordinator,
                           const StageContext& context) -> absl::StatusOr<JobSpec> {
    absl::StatusOr<JobSpec> spec = PrepareDatabaseJob(coordinator,
                                                      run.corridor + "/corridor.db",
                                                      run.corridor + "/gnss.csv",
                                                      "",
                                                      run.options,
                                                      context);
    ORBWEAVE_RETURN_IF_ERROR(AwaitWorkers(coordinator, run.workers, context.stop));
    RestartPeakMemory();
    cpu_start_s = ProcessCpuSeconds();
    return spec;
  };
  const auto conclude = [&](ClientApi& coordinator, const JobStatus& job) -> absl::Status {
    const double coordinator_cpu_s = ProcessCpuSeconds() - cpu_start_s;
    const uint64_t coordinator_peak_bytes = PeakMemoryBytes();
    ORBWEAVE_ASSIGN_OR_RETURN(measurement, Recorded(coordinator, job));
    ORBWEAVE_ASSIGN_OR_RETURN(measurement.timings, coordinator.GetTimings(job.id));
    measurement.workers = run.workers;
    measurement.slots = run.slots;
    measurement.wall_s = job.elapsed_s;
    measurement.overhead = MeasureOverhead(measurement.timings, measurement.tasks);
    measurement.coordinator_cpu_s = coordinator_cpu_s;
    measurement.coordinator_peak_bytes = coordinator_peak_bytes;
    return absl::OkStatus();
  };
  const StopSignals signals;
  ORBWEAVE_RETURN_IF_ERROR(RunLocalJob(
      {.output = run.folder, .fleet = run.fleet, .prepare = prepare, .conclude = conclude},
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
