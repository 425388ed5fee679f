// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cli/command.h"
#include "cli/coordinator_argument.h"
#include "worker/worker_loop.h"

namespace orbweave {

struct WorkOptions {
  CoordinatorArgument join{};
  std::string token_path{};  ///< file of a join token; empty: none, or in the environment
  WorkerOptions worker{};
  int parent_pid = 0;  ///< when given, the worker dies with that process
};

/// Declares the options of `orbweave work`; `stages` is what the worker can do and outlives the
/// command.
void AddWorkCommand(CLI::App& app, SelectedCommand& selected, const StageLookup& stages);

}  // namespace orbweave
