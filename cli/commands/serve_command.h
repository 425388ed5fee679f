// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/process/command.h"
#include "core/pipeline/job_plan.h"

namespace orbweave {

/// `orbweave serve`: a coordinator of jobs of the kinds that `find_plan` knows, until it is told to
/// stop.
void AddServeCommand(CLI::App& app, SelectedCommand& selected, const PlanLookup& find_plan);

}  // namespace orbweave
