// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "cli/arguments/option_arguments.h"
#include "cli/bench/bench_engine.h"

namespace orbweave {

/// Nodes are allocations of Slurm, as those of `orbweave launch slurm`.
[[nodiscard]] std::unique_ptr<BenchEngine> MakeSlurmEngine(const EngineArgument& argument,
                                                           const OptionArguments& options);

}  // namespace orbweave
