// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// orbweave dense: the dense cloud of a finished model.
void AddDenseCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
