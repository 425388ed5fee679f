// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave retry`: a job that failed or was cancelled goes on.
void AddRetryCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
