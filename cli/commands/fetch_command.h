// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave fetch`: writes the results of a coordinator's finished job.
void AddFetchCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
