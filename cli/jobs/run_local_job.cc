// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/jobs/run_local_job.h"

#include <csignal>
#include <cstdio>

#include "cli/fleet/local_fleet.h"
#include "cli/process/exit_code.h"
#include "cli/progress/preparation_bar.h"
#include "cli/progress/progress_bar.h"
#include "cli/results/write_job.h"
#include "core/io/file.h"
#include "stages/plans.h"

namespace orbweave {
namespace {

absl::StatusOr<JobSpec> PrepareShowingProgress(LocalFleet& fleet,
                                               const LocalJob& job,
                                               const std::stop_token& stop) {
  PreparationBar bar(stderr);
  const auto show = [&bar](const Progress& progress) { bar.Update(progress); };
  return job.prepare(fleet.coordinator(), {.stop = stop, .report = show});
}

absl::StatusOr<JobStatus> RunShowingProgress(LocalFleet& fleet,
                                             const JobSpec& spec,
                                             const std::stop_token& stop) {
  ProgressBar bar(stderr);
  absl::StatusOr<JobStatus> status = fleet.RunJob(
      spec, [&bar](const JobStatus& current) { bar.Update(current); }, stop);
  bar.Finish();
  return status;
}

absl::Status Interrupted(const std::string& output, int signal) {
  const std::string message =
      "stopped; finished work is kept in " + output + ", the same command goes on from there";
  return signal == SIGTERM ? StoppedError(message) : absl::CancelledError(message);
}

/// What was given; of a job that goes on also the store that it had before.
absl::StatusOr<StoreArgument> StoreOf(const LocalJob& job) {
  const std::string state_dir = job.output + "/.orbweave";
  StoreArgument store = job.fleet.store;
  if (!store.store.empty()) {
    ORBWEAVE_RETURN_IF_ERROR(RememberStore(state_dir, store));
    return store;
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const StoreArgument before, RememberedStore(state_dir));
  store.store = before.store;
  if (store.keys.empty()) store.keys = before.keys;
  return store;
}

/// As long as nobody stops it.
absl::Status RunOn(LocalFleet& fleet, const LocalJob& job, const std::stop_token& stop) {
  ORBWEAVE_ASSIGN_OR_RETURN(const JobSpec spec, PrepareShowingProgress(fleet, job, stop));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus status, RunShowingProgress(fleet, spec, stop));
  if (job.conclude) return job.conclude(fleet.coordinator(), status);
  return WriteJob(fleet.coordinator(), status, job.output, job.fail_on);
}

}  // namespace

absl::Status RunLocalJob(const LocalJob& job, const StopSignals& signals) {
  ORBWEAVE_RETURN_IF_ERROR(job.fleet.Check());
  ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(job.output));
  LocalFleetOptions fleet_options{.coordinator = {.state_dir = job.output + "/.orbweave",
                                                  .lease_s = job.fleet.lease_s,
                                                  .find_plan = FindJobPlan},
                                  .door = job.fleet.door,
                                  .monitoring = job.fleet.monitoring,
                                  .journal_folder = job.fleet.journal_folder,
                                  .workers = job.fleet.workers};
  ORBWEAVE_ASSIGN_OR_RETURN(const StoreArgument store, StoreOf(job));
  ORBWEAVE_RETURN_IF_ERROR(store.OpenFor(fleet_options.coordinator));
  fleet_options.roots = store.Folders();
  ORBWEAVE_ASSIGN_OR_RETURN(const auto fleet, LocalFleet::Start(fleet_options));
  const absl::Status end = RunOn(*fleet, job, signals.token());
  const bool is_stopped =
      signals.token().stop_requested() && (absl::IsCancelled(end) || (end.ok() && !job.is_last));
  if (end.ok() && !job.is_last) fleet->ComesBack();
  if (!is_stopped) return end;
  if (signals.first() == SIGTERM) fleet->ComesBack();
  return Interrupted(job.output, signals.first());
}

}  // namespace orbweave
