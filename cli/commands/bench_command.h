// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave bench`: what this program takes, and what more workers would do.
void AddBenchCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
