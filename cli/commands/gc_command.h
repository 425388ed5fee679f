// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave gc`: what no job needs goes off the disk.
void AddGcCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
