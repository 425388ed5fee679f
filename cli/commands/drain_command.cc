// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/commands/drain_command.h"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "cli/arguments/coordinator_argument.h"
#include "cli/process/exit_code.h"
#include "core/io/printable_text.h"

namespace orbweave {
namespace {

struct DrainOptions {
  CoordinatorArgument coordinator{};
  std::string worker{};
};

absl::Status Drain(const DrainOptions& options) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto coordinator, Connect(options.coordinator));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<std::string> drained,
                            coordinator->DrainWorkers(options.worker));
  for (const std::string& worker : drained)
    std::printf("worker %s finishes what it has and leaves\n", PrintableText(worker).c_str());
  return absl::OkStatus();
}

}  // namespace

void AddDrainCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("drain", "Give workers no more tasks and let them leave");
  const auto options = std::make_shared<DrainOptions>();
  AddCoordinatorArgument(*command, options->coordinator);
  command
      ->add_option(
          "worker",
          options->worker,
          "Its name as status shows it, or how its name alone begins; with * at the end all "
          "workers whose names begin so")
      ->required();
  command->footer(
      "Examples:\n"
      "  orbweave drain --coordinator 127.0.0.1:7000 second\n"
      "  orbweave drain --coordinator 127.0.0.1:7000 'node7/*'\n"
      "Their processes end then with 0. Started again they get tasks again.");
  command->callback(
      [options, &selected] { selected.run = [options] { return ReportStatus(Drain(*options)); }; });
}

}  // namespace orbweave
