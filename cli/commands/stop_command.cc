// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/commands/stop_command.h"

#include <cstdio>
#include <memory>

#include "cli/arguments/coordinator_argument.h"
#include "cli/process/exit_code.h"

namespace orbweave {
namespace {

absl::Status Stop(const CoordinatorArgument& argument) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto coordinator, Connect(argument));
  ORBWEAVE_RETURN_IF_ERROR(coordinator->StopCoordinator());
  std::printf("the coordinator sends its workers home and ends\n");
  return absl::OkStatus();
}

}  // namespace

void AddStopCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("stop", "End a coordinator and send its workers home");
  const auto argument = std::make_shared<CoordinatorArgument>();
  AddCoordinatorArgument(*command, *argument);
  command->footer(
      "Example:\n"
      "  orbweave stop --coordinator 127.0.0.1:7000\n"
      "Its jobs go on when it is started again on the same state. An engine that stops it by "
      "SIGTERM sends nobody home: it comes back.");
  command->callback([argument, &selected] {
    selected.run = [argument] { return ReportStatus(Stop(*argument)); };
  });
}

}  // namespace orbweave
