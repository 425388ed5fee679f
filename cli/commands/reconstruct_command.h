// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "cli/process/command.h"

namespace orbweave {

/// `orbweave reconstruct`: keypoints and matches from a COLMAP database, on this machine.
void AddReconstructCommand(CLI::App& app, SelectedCommand& selected);

}  // namespace orbweave
