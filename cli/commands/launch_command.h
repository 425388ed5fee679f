// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave launch slurm`: has an engine that owns machines run a job on them.
void AddLaunchCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
