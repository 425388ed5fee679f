// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave bench dense`: time, memory and truth of the dense cloud of a street whose poses are
/// known, on several numbers of workers.
void AddBenchDense(CLI::App& bench, SelectedCommand& selected);

}  // namespace orbweave
