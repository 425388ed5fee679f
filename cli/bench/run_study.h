// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "bench/scaling/engine_study.h"
#include "cli/arguments/option_arguments.h"
#include "cli/bench/bench_engine.h"

namespace orbweave {

/// Declares `--engine` and what belongs to it; returns `--engine`.
CLI::Option* AddEngineArguments(CLI::App& command, EngineArgument& argument);

/// All jobs of a study; says on stderr how far it is. `scratch`: a folder for what it needs, on
/// storage that all nodes see. InvalidArgument, FailedPrecondition: such nodes cannot be had here,
/// and why; else errors of the engine.
[[nodiscard]] absl::StatusOr<std::vector<StudyRun>> RunStudy(const EngineArgument& argument,
                                                             const OptionArguments& options,
                                                             const std::string& scratch);

}  // namespace orbweave
