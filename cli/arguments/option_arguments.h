// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "stages/pipeline_options.h"

namespace orbweave {

/// --config and --set of every command that starts a job.
struct OptionArguments {
  std::string config{};             ///< file of "section.key=value" lines
  std::vector<std::string> sets{};  ///< "section.key=value", after the file, in order
};

void AddOptionArguments(CLI::App& command, OptionArguments& arguments);

/// Defaults of the preset that is chosen, then the file, then --set. InvalidArgument names option,
/// line and the nearest right name.
[[nodiscard]] absl::StatusOr<PipelineOptions> ReadOptions(const OptionArguments& arguments);

}  // namespace orbweave
