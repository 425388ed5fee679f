// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/drain_command.h"

#include <cstdio>
#include <memory>

#include "cli/coordinator_argument.h"
#include "cli/exit_code.h"

namespace orbweave {
namespace {

struct DrainOptions {
  CoordinatorArgument coordinator{};
  std::string worker{};
};

absl::Status Drain(const DrainOptions& options) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto coordinator, Connect(options.coordinator));
  ORBWEAVE_RETURN_IF_ERROR(coordinator->DrainWorker(options.worker));
  std::printf("worker %s finishes what it has and leaves\n", options.worker.c_str());
  return absl::OkStatus();
}

}  // namespace

void AddDrainCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("drain", "Give a worker no more tasks and let it leave");
  const auto options = std::make_shared<DrainOptions>();
  AddCoordinatorArgument(*command, options->coordinator);
  command->add_option("worker", options->worker, "Its name, as status shows it")->required();
  command->footer(
      "Example:\n"
      "  orbweave drain --coordinator 127.0.0.1:7000 second\n"
      "Its process ends then with 0. Started again it gets tasks again.");
  command->callback(
      [options, &selected] { selected.run = [options] { return ReportStatus(Drain(*options)); }; });
}

}  // namespace orbweave
