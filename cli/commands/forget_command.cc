// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/commands/forget_command.h"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "cli/arguments/coordinator_argument.h"
#include "cli/fleet/find_job.h"
#include "cli/process/exit_code.h"

namespace orbweave {
namespace {

struct ForgetOptions {
  CoordinatorArgument coordinator{};
  std::vector<std::string> jobs{};
};

absl::Status Forget(const ForgetOptions& options) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto coordinator, Connect(options.coordinator));
  for (const std::string& prefix : options.jobs) {
    ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus job, FindJob(*coordinator, prefix));
    ORBWEAVE_RETURN_IF_ERROR(coordinator->ForgetJob(job.id));
    std::printf("forgot job %s (%s)\n", job.id.ToShortHex().c_str(), job.spec.label.c_str());
  }
  return absl::OkStatus();
}

}  // namespace

void AddForgetCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("forget", "Take jobs that have ended off the list");
  const auto options = std::make_shared<ForgetOptions>();
  AddCoordinatorArgument(*command, options->coordinator);
  command->add_option("job", options->jobs, "First digits of the jobs' ids")->required();
  command->footer(
      "Example:\n"
      "  orbweave forget --coordinator 127.0.0.1:7000 3f2a 77b0\n"
      "Nothing is kept for them any more: orbweave gc removes what no other job needs. Models that "
      "were written are not touched.");
  command->callback([options, &selected] {
    selected.run = [options] { return ReportStatus(Forget(*options)); };
  });
}

}  // namespace orbweave
