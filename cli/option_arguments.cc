// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/option_arguments.h"

#include "core/io/file.h"

namespace orbweave {

void AddOptionArguments(CLI::App& command, OptionArguments& arguments) {
  command.add_option(
      "--config", arguments.config, "File of section.key=value lines (see: orbweave options)");
  command.add_option("--set", arguments.sets, "Set one option: section.key=value; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

absl::StatusOr<PipelineOptions> ReadOptions(const OptionArguments& arguments) {
  PipelineOptions options;
  if (!arguments.config.empty()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string text, ReadFile(arguments.config));
    ORBWEAVE_ASSIGN_OR_RETURN(options, PipelineOptionsFromText(text, arguments.config));
  }
  for (const std::string& assignment : arguments.sets) {
    ORBWEAVE_RETURN_IF_ERROR(SetPipelineOption(options, assignment));
  }
  return options;
}

}  // namespace orbweave
