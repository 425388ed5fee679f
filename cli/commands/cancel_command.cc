// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/commands/cancel_command.h"

#include <cstdio>
#include <memory>
#include <string>

#include "cli/arguments/coordinator_argument.h"
#include "cli/fleet/find_job.h"
#include "cli/process/exit_code.h"

namespace orbweave {
namespace {

struct CancelOptions {
  CoordinatorArgument coordinator{};
  std::string job{};
};

absl::Status Cancel(const CancelOptions& options) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto coordinator, Connect(options.coordinator));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus job, FindJob(*coordinator, options.job));
  if (job.state != JobState::kRunning) {
    return absl::FailedPreconditionError("job " + job.id.ToShortHex() + " has ended already");
  }
  ORBWEAVE_RETURN_IF_ERROR(coordinator->CancelJob(job.id));
  std::printf("cancelled job %s; its finished tasks are kept\n", job.id.ToShortHex().c_str());
  return absl::OkStatus();
}

}  // namespace

void AddCancelCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("cancel", "End a job; what it finished is kept");
  const auto options = std::make_shared<CancelOptions>();
  AddCoordinatorArgument(*command, options->coordinator);
  command->add_option("job", options->job, "First digits of the job's id")->required();
  command->footer(
      "Example:\n"
      "  orbweave cancel --coordinator 127.0.0.1:7000 3f2a\n"
      "Submitting the same job again takes up what it finished.");
  command->callback([options, &selected] {
    selected.run = [options] { return ReportStatus(Cancel(*options)); };
  });
}

}  // namespace orbweave
