// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run_local_job.h"

#include <cstdio>

#include "cli/format_summary.h"
#include "cli/local_fleet.h"
#include "cli/progress_bar.h"
#include "cli/stop_signals.h"
#include "cli/write_outputs.h"
#include "core/io/file.h"
#include "stages/plans.h"

namespace orbweave {
namespace {

absl::StatusOr<JobStatus> RunShowingProgress(LocalFleet& fleet,
                                             const JobSpec& spec,
                                             const std::stop_token& stop) {
  ProgressBar bar(stderr);
  absl::StatusOr<JobStatus> status = fleet.RunJob(
      spec, [&bar](const JobStatus& current) { bar.Update(current); }, stop);
  bar.Finish();
  return status;
}

/// A job that ended without a model is an error that says why.
absl::Status CheckEnd(const JobStatus& status) {
  if (status.state == JobState::kFailed) return absl::InternalError(status.error);
  if (status.state == JobState::kCancelled) return absl::CancelledError("the job was cancelled");
  return absl::OkStatus();
}

absl::Status Interrupted(const std::string& output) {
  return absl::CancelledError("stopped; finished work is kept in " + output +
                              ", the same command goes on from there");
}

absl::Status WriteAndSummarize(ClientApi& coordinator,
                               const JobStatus& status,
                               const LocalJob& job) {
  const std::string& output = job.output;
  ORBWEAVE_ASSIGN_OR_RETURN(const JobReport report, WriteOutputs(coordinator, status, output));
  std::fputs(FormatSummary(report, output).c_str(), stdout);
  if (report.registered == 0) {
    return absl::InternalError("no image could be registered; the reasons are in " + output +
                               "/report.html");
  }
  return CheckVerdict(report.verdict, job.fail_on);
}

}  // namespace

absl::Status RunLocalJob(const LocalJob& job) {
  const StopSignals signals;
  ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(job.output));
  const LocalFleetOptions fleet_options{
      .coordinator = {.state_dir = job.output + "/.orbweave", .find_plan = FindJobPlan},
      .workers = job.workers};
  ORBWEAVE_ASSIGN_OR_RETURN(const auto fleet, LocalFleet::Start(fleet_options));
  const StageContext context{.stop = signals.token()};
  const absl::StatusOr<JobSpec> spec = job.prepare(fleet->coordinator(), context);
  if (signals.token().stop_requested()) return Interrupted(job.output);
  ORBWEAVE_RETURN_IF_ERROR(spec.status());
  const absl::StatusOr<JobStatus> status = RunShowingProgress(*fleet, *spec, signals.token());
  if (signals.token().stop_requested()) return Interrupted(job.output);
  ORBWEAVE_RETURN_IF_ERROR(status.status());
  ORBWEAVE_RETURN_IF_ERROR(CheckEnd(*status));
  if (job.conclude) return job.conclude(fleet->coordinator(), *status);
  return WriteAndSummarize(fleet->coordinator(), *status, job);
}

}  // namespace orbweave
