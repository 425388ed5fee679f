// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave status`: the jobs of a coordinator.
void AddStatusCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
