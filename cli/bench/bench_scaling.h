// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave bench scaling`: runs jobs of several sizes on several numbers of workers, and predicts
/// from their tasks what more workers would do.
void AddBenchScaling(CLI::App& bench, SelectedCommand& selected);

}  // namespace orbweave
