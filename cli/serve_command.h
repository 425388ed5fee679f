// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/command.h"

namespace orbweave {

/// `orbweave serve`: a coordinator until it is told to stop.
void AddServeCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
