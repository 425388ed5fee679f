// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"
#include "worker/task_runner.h"

namespace orbweave {

/// Declares `orbweave exec-tasks`, the process in which a worker runs its tasks; only TaskProcess
/// starts it. `stages` is what it can do and outlives the command.
void AddExecTasksCommand(CLI::App& app, SelectedCommand& selected, const StageLookup& stages);

}  // namespace orbweave
