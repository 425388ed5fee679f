// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/commands/status_command.h"

#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>

#include "cli/arguments/coordinator_argument.h"
#include "cli/fleet/find_job.h"
#include "cli/fleet/wait_for_job.h"
#include "cli/process/exit_code.h"
#include "cli/process/stop_signals.h"
#include "cli/progress/format_status.h"
#include "cli/progress/progress_bar.h"

namespace orbweave {
namespace {

struct StatusOptions {
  CoordinatorArgument coordinator{};
  std::string job{};
  bool json = false;
  bool watch = false;
  bool wanted = false;
};

absl::StatusOr<std::vector<JobStatus>> WantedJobs(JobApi& coordinator, const std::string& prefix) {
  if (prefix.empty()) return coordinator.ListJobs();
  ORBWEAVE_ASSIGN_OR_RETURN(JobStatus job, FindJob(coordinator, prefix));
  return std::vector<JobStatus>{std::move(job)};
}

/// Jobs and who works for the coordinator.
void Print(const std::vector<JobStatus>& jobs,
           const std::vector<WorkerStatus>& workers,
           bool as_json) {
  if (!as_json && jobs.empty()) std::puts("no jobs");
  for (const JobStatus& job : jobs) {
    std::fputs((as_json ? JobStatusToJson(job) + "\n" : FormatJobStatus(job)).c_str(), stdout);
  }
  std::fputs((as_json ? WorkersToJson(workers) + "\n" : FormatWorkers(workers)).c_str(), stdout);
}

/// The job in place of what the terminal showed before.
void Redraw(const JobStatus& job, const std::vector<WorkerStatus>& workers) {
  constexpr const char* kHome = "\033[H\033[J";
  std::fputs((kHome + FormatJobStatus(job) + FormatWorkers(workers)).c_str(), stdout);
  std::fflush(stdout);
}

/// Follows the job asked for, or the last submitted one, to its end: on a terminal as a table that
/// is drawn anew, elsewhere by a line now and then.
absl::Status Watch(JobApi& coordinator, const JobStatus& job, const std::stop_token& stop) {
  ProgressBar bar(stderr);
  const bool is_terminal = ::isatty(STDOUT_FILENO) == 1;
  const auto show = [&](const JobStatus& status) {
    if (!is_terminal) return bar.Update(status);
    const absl::StatusOr<std::vector<WorkerStatus>> workers = coordinator.ListWorkers();
    if (workers.ok()) Redraw(status, *workers);
  };
  ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus last, WaitForJob(coordinator, job.id, show, {}, stop));
  bar.Finish();
  if (is_terminal) return absl::OkStatus();
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<WorkerStatus> workers, coordinator.ListWorkers());
  Print({last}, workers, false);
  return absl::OkStatus();
}

absl::Status ShowStatus(const StatusOptions& options) {
  const StopSignals signals;
  const double patience_s = options.watch ? kJobPatience_s : kAskPatience_s;
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto coordinator,
      Connect(options.coordinator, {.patience_s = patience_s, .stop = signals.token()}));
  if (options.wanted) {
    ORBWEAVE_ASSIGN_OR_RETURN(const uint32_t slots, coordinator->CountWantedSlots());
    std::printf("%u\n", slots);
    return absl::OkStatus();
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<JobStatus> jobs,
                            WantedJobs(*coordinator, options.job));
  if (options.watch && !jobs.empty()) return Watch(*coordinator, jobs.back(), signals.token());
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<WorkerStatus> workers, coordinator->ListWorkers());
  Print(jobs, workers, options.json);
  return absl::OkStatus();
}

}  // namespace

void AddStatusCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("status", "Show the jobs and workers of a coordinator");
  const auto options = std::make_shared<StatusOptions>();
  AddCoordinatorArgument(*command, options->coordinator);
  command->add_option("job", options->job, "First digits of a job's id (default: all jobs)");
  CLI::Option* json = command->add_flag(
      "--json", options->json, "One JSON object per job and line, then one with the workers");
  CLI::Option* watch =
      command->add_flag("--watch", options->watch, "Follow the job, or the last one, to its end")
          ->excludes(json);
  command
      ->add_flag("--wanted",
                 options->wanted,
                 "Only a number: the slots that there is work for, as /wanted of --http says")
      ->excludes(json)
      ->excludes(watch);
  command->footer(
      "Examples:\n"
      "  orbweave status --coordinator 127.0.0.1:7000\n"
      "  orbweave status --coordinator 127.0.0.1:7000 --watch\n"
      "  orbweave status --coordinator 127.0.0.1:7000 3f2a --json\n"
      "  orbweave status --coordinator @model/coordinator.json --wanted");
  command->callback([options, &selected] {
    selected.run = [options] { return ReportStatus(ShowStatus(*options)); };
  });
}

}  // namespace orbweave
