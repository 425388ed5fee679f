// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// Declares `orbweave keys init`, `add` and `token`.
void AddKeysCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
