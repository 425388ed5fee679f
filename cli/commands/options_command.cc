// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/commands/options_command.h"

#include <cstdio>
#include <memory>

#include "cli/arguments/option_arguments.h"
#include "cli/process/exit_code.h"

namespace orbweave {
namespace {

/// A file that --config reads back: each option under its help and range.
absl::Status PrintOptions(const OptionArguments& arguments) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, ReadOptions(arguments));
  for (const OptionInfo& info : DescribePipelineOptions(options)) {
    std::printf("# %s %s\n%s=%s\n",
                info.help.c_str(),
                info.range.c_str(),
                info.name.c_str(),
                info.value.c_str());
  }
  return absl::OkStatus();
}

}  // namespace

void AddOptionsCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand(
      "options", "Print every option with help and range, as a file for --config");
  const auto arguments = std::make_shared<OptionArguments>();
  AddOptionArguments(*command, *arguments);
  command->footer("Example:\n  orbweave options --set mapping.min_inliers=30 > street.conf");
  command->callback([arguments, &selected] {
    selected.run = [arguments] { return ReportStatus(PrintOptions(*arguments)); };
  });
}

}  // namespace orbweave
