// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/arguments/coordinator_argument.h"
#include "cli/arguments/worker_term_argument.h"
#include "cli/process/command.h"
#include "worker/task_watch.h"
#include "worker/worker_loop.h"

namespace orbweave {

struct WorkOptions {
  CoordinatorArgument join{};
  std::string token_path{};  ///< file of a join token; empty: none, or in the environment
  WorkerOptions worker{};
  WorkerTermArgument term{};
  TaskLimits task_limits{};
  std::optional<uint64_t> memory_bytes{};  ///< offered; nothing: what the machine has
  std::optional<uint32_t> gpus{};          ///< the same
  int parent_pid = 0;                      ///< when given, the worker dies with that process
};

/// Declares the options of `orbweave work`. What the worker can do is up to `exec-tasks`.
void AddWorkCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
