// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave export`: what a finished job computed, in the formats of other programs.
void AddExportCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
