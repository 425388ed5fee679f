// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave stop`: ends a coordinator and sends its workers home.
void AddStopCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
