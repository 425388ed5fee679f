// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/arguments/option_arguments.h"

#include "core/io/file.h"
#include "stages/preset_options.h"

namespace orbweave {

void AddOptionArguments(CLI::App& command, OptionArguments& arguments) {
  command.add_option(
      "--config", arguments.config, "File of section.key=value lines (see: orbweave options)");
  command.add_option("--set", arguments.sets, "Set one option: section.key=value; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

absl::StatusOr<PipelineOptions> ReadOptions(const OptionArguments& arguments) {
  std::string text;
  if (!arguments.config.empty()) {
    ORBWEAVE_ASSIGN_OR_RETURN(text, ReadFile(arguments.config));
  }
  return OptionsOverPreset(text, arguments.config, arguments.sets);
}

}  // namespace orbweave
