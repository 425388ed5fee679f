// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bench/scaling/job_measurement.h"
#include "cli/arguments/option_arguments.h"
#include "cli/bench/bench_engine.h"
#include "cli/process/command.h"

namespace orbweave {

/// `orbweave bench measure`, which the engines of `bench scaling` start: it coordinates one
/// corridor's job and leaves OUTPUT/measurement.json.
void AddBenchMeasure(CLI::App& bench, SelectedCommand& selected);

/// Its arguments, but for --output and those of its fleet.
[[nodiscard]] std::vector<std::string> MeasureArguments(const NodesRun& run,
                                                        uint32_t slots,
                                                        const OptionArguments& options);

/// What it left in `output`. NotFound, DataLoss: nothing, or something else.
[[nodiscard]] absl::StatusOr<JobMeasurement> ReadMeasurement(const std::string& output);

}  // namespace orbweave
