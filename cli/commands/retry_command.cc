// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/commands/retry_command.h"

#include <cstdio>
#include <memory>
#include <string>

#include "cli/arguments/coordinator_argument.h"
#include "cli/fleet/find_job.h"
#include "cli/process/exit_code.h"
#include "cli/progress/format_status.h"

namespace orbweave {
namespace {

struct RetryOptions {
  CoordinatorArgument coordinator{};
  std::string job{};
};

absl::Status Retry(const RetryOptions& options) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto coordinator, Connect(options.coordinator));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus job, FindJob(*coordinator, options.job));
  if (job.state == JobState::kRunning || job.state == JobState::kDone) {
    return absl::FailedPreconditionError("job " + job.id.ToShortHex() + " is " +
                                         std::string(JobStateName(job.state)) +
                                         ": there is nothing to try again");
  }
  ORBWEAVE_RETURN_IF_ERROR(coordinator->SubmitJob(job.spec).status());
  std::printf("job %s goes on; what it finished is kept\n", job.id.ToShortHex().c_str());
  return absl::OkStatus();
}

}  // namespace

void AddRetryCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("retry", "Let a failed or cancelled job go on");
  const auto options = std::make_shared<RetryOptions>();
  AddCoordinatorArgument(*command, options->coordinator);
  command->add_option("job", options->job, "First digits of the job's id")->required();
  command->footer(
      "Example:\n"
      "  orbweave retry --coordinator 127.0.0.1:7000 3f2a\n"
      "Its tasks may fail as often again as if they had never failed; finished tasks are kept.");
  command->callback(
      [options, &selected] { selected.run = [options] { return ReportStatus(Retry(*options)); }; });
}

}  // namespace orbweave
