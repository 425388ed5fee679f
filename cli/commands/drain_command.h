// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave drain`: a worker finishes what it has and leaves.
void AddDrainCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
