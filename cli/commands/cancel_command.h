// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave cancel`: ends a job; what it finished is kept.
void AddCancelCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
