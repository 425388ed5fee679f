// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave inspect`: pictures and numbers of one pair or one image of a job.
void AddInspectCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
