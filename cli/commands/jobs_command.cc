// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/commands/jobs_command.h"

#include <cstdio>
#include <memory>
#include <string>

#include "cli/arguments/coordinator_argument.h"
#include "cli/process/exit_code.h"
#include "cli/progress/format_status.h"

namespace orbweave {
namespace {

struct JobsOptions {
  CoordinatorArgument coordinator{};
};

absl::Status ListJobs(const JobsOptions& options) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto coordinator, Connect(options.coordinator));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<JobStatus> jobs, coordinator->ListJobs());
  if (jobs.empty()) std::puts("no jobs");
  for (const JobStatus& job : jobs) std::fputs(FormatJobLine(job).c_str(), stdout);
  return absl::OkStatus();
}

}  // namespace

void AddJobsCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("jobs", "List the jobs of a coordinator");
  const auto options = std::make_shared<JobsOptions>();
  AddCoordinatorArgument(*command, options->coordinator);
  command->footer(
      "Example:\n"
      "  orbweave jobs --coordinator 127.0.0.1:7000\n"
      "The oldest comes first, which is the order they are served in.");
  command->callback([options, &selected] {
    selected.run = [options] { return ReportStatus(ListJobs(*options)); };
  });
}

}  // namespace orbweave
