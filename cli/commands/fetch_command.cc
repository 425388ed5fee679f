// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/commands/fetch_command.h"

#include <memory>
#include <string>

#include "cli/arguments/coordinator_argument.h"
#include "cli/arguments/fail_on_argument.h"
#include "cli/fleet/find_job.h"
#include "cli/process/exit_code.h"
#include "cli/results/write_job.h"
#include "core/io/file.h"

namespace orbweave {
namespace {

struct FetchArguments {
  CoordinatorArgument coordinator{};
  std::string job{};
  std::string output{};
  FailOn fail_on{};
};

absl::Status Fetch(const FetchArguments& arguments) {
  ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(arguments.output));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto coordinator, Connect(arguments.coordinator));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus job, FindJob(*coordinator, arguments.job));
  return WriteJob(*coordinator, job, arguments.output, arguments.fail_on);
}

}  // namespace

void AddFetchCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("fetch", "Write the results of a finished job");
  const auto arguments = std::make_shared<FetchArguments>();
  AddCoordinatorArgument(*command, arguments->coordinator);
  command->add_option("JOB", arguments->job, "First digits of the job's id")->required();
  command->add_option("--output", arguments->output, "Folder of the results")->required();
  AddFailOnArgument(*command, arguments->fail_on);
  command->footer(
      "Example:\n"
      "  orbweave fetch --coordinator 127.0.0.1:7000 3f2a --output model\n"
      "orbweave jobs lists the ids. What a job left stays until it is forgotten.");
  command->callback([arguments, &selected] {
    selected.run = [arguments] { return ReportStatus(Fetch(*arguments)); };
  });
}

}  // namespace orbweave
