// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave forget`: jobs that have ended go off the list.
void AddForgetCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
