// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave synth`: streets with exact truth.
void AddSynthCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
