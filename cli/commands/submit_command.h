// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave submit`: a folder of panoramas, by the workers of a running coordinator.
void AddSubmitCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
