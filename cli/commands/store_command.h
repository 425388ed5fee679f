// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave store check`: whether an object store does all that Orbweave asks of it.
void AddStoreCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
