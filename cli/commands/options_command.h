// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave options`: every option with its value, range and meaning.
void AddOptionsCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
