// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave jobs`: one line per job of a coordinator.
void AddJobsCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
